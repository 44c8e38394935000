#include "launch/arm_task.hpp"
#include "tasks/press/press.hpp"

int main(int argc, char** argv) {
  using namespace mrroc;
  return launch::run_arm_task({.name = "press",
                               .about = "One arm comes to a surface, holds 4 N (task.force) and draws back.",
                               .config = press::config(),
                               .behaviours = launch::words_of(press::kPress),
                               .ecp = ecp::solo(press::kPress, press::read_force),
                               .figures = press::figures,
                               .pictures = launch::force_picture<Axis::z, press::read_force>},
                              argc, argv);
}
