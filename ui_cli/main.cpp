#include <iostream>

#include "base/link/session.hpp"
#include "edp/stability_command.hpp"
#include "ui_cli/commands.hpp"

int main(int argc, char** argv) {
  using namespace mrroc;
  return ui::run(
      argc, argv,
      {std::cout,
       std::cerr,
       link::session_directory(),
       link::open_lcm,
       {},
       {{"stability", "Tell which contact the force law bears (no task needed)", edp::run_stability}}});
}
