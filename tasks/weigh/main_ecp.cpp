#include "tasks/weigh/weigh.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "Control subsystem (ECP) of an arm that weighs its tool.",
                                 mrroc::weigh::run_ecp);
}
