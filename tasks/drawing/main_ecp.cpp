#include "tasks/drawing/ecp_body.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "Control subsystem (ECP) of an arm that draws.",
                                 mrroc::drawing::run_drawing_ecp);
}
