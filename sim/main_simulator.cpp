#include "sim/shell/process.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "The simulator: arms, sensors, paper and hands.",
                                 mrroc::sim::run_simulator_process);
}
