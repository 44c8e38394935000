#include "base/link/child_main.hpp"
#include "robots/irb6/robot_type.hpp"

int main(int argc, char** argv) {
  using namespace mrroc;
  return link::child_main(argc, argv, "Effector driver of an IRb-6 arm.",
                          robots::driver_of({&irb6::postument(), &irb6::track()}));
}
