#include "launch/arm_task.hpp"
#include "touch.hpp"

int main(int argc, char** argv) {
  using namespace mrroc;
  return launch::run_arm_task({.name = "touch",
                               .about = "One arm touches a surface with 2 N and draws back.",
                               .config = touch::config(),
                               .behaviours = launch::words_of(touch::kTouch),
                               .ecp = ecp::solo(touch::kTouch),
                               .figures = touch::figures,
                               .pictures = launch::force_picture<Axis::z, 2>},
                              argc, argv);
}
