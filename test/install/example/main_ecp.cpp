#include "touch.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "ECP of an arm that touches.",
                                 mrroc::ecp::solo(mrroc::touch::kTouch));
}
