#include "sim/arm_task.hpp"
#include "tasks/press/press.hpp"

int main(int argc, char** argv) {
  using namespace mrroc;
  return sim::run_arm_task({.name = "press",
                            .about = "One arm comes to a surface, holds 4 N and draws back.",
                            .config = press::config(),
                            .behaviours = sim::words_of(press::kPress),
                            .ecp = ecp::solo(press::kPress),
                            .figures = press::figures,
                            .pictures = sim::force_picture<Axis::z, 4>},
                           argc, argv);
}
