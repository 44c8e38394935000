#include "tasks/press/press.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "ECP of an arm that presses.",
                                 mrroc::ecp::solo(mrroc::press::kPress, mrroc::press::read_force));
}
