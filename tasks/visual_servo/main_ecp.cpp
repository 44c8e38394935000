#include "tasks/visual_servo/config.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv,
                                 "Control subsystem (ECP) of an arm that servoes on what cameras see.",
                                 mrroc::visual_servo::run_ecp);
}
