#include "sim/config.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "The simulated world: arms, sensors, paper and hands.",
                                 mrroc::sim::run_world_process);
}
