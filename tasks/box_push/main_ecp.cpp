#include "tasks/box_push/config.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(
      argc, argv,
      "Control subsystem (ECP) of a platform that pushes: hands its coordinator's fragments over.",
      mrroc::box_push::run_ecp);
}
