#include "tasks/calibrate_cell/calibrate_cell.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "Control subsystem (ECP) of an arm that calibrates its cell.",
                                 mrroc::calibrate_cell::run_ecp);
}
