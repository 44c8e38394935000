#include "ecp/transparent.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv,
                                 "Control subsystem (ECP) of an arm that copies the coordinator's orders.",
                                 mrroc::ecp::run_transparent);
}
