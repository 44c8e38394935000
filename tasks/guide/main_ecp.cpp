#include "tasks/guide/config.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv,
                                 "Control subsystem (ECP) of an arm that is led on a virtual fixture.",
                                 mrroc::guide::run_ecp);
}
