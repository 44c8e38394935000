#include "tasks/rex_drive/config.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(
      argc, argv, "Control subsystem (ECP) of a mobile platform: plans and hands over trajectories.",
      mrroc::rex_drive::run_ecp);
}
