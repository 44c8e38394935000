#include "base/link/child_main.hpp"
#include "edp/shell.hpp"
#include "robots/irb6/edp_body.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "Effector driver of an IRb-6 arm.", mrroc::irb6::run_edp_of_arm);
}
