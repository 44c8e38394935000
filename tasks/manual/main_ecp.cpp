#include "tasks/manual/config.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "Control subsystem (ECP) of an arm that is led by hand.",
                                 mrroc::manual::run_ecp);
}
