#include "tasks/rubik/config.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "Control subsystem (ECP) of an arm that turns faces of a cube.",
                                 mrroc::rubik::run_ecp);
}
