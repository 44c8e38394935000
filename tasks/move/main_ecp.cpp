#include "tasks/move/cell/arm_body.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv,
                                 "Control subsystem (ECP) of an arm that executes motions of a file.",
                                 mrroc::any_motion::run_move_ecp);
}
