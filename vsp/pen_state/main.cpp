#include "vsp/pen_state/config.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "Virtual sensor (VSP) of the state of a pen.",
                                 mrroc::vsp::run_pen_state);
}
