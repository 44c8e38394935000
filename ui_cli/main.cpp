#include <iostream>

#include "base/link/session.hpp"
#include "edp/stability_command.hpp"
#include "ui_cli/commands.hpp"
#include "ui_cli/doctor.hpp"
#include "ui_cli/explain.hpp"
#include "ui_cli/view/view_command.hpp"

int main(int argc, char** argv) {
  using namespace mrroc;
  return ui::run(
      argc, argv,
      {std::cout,
       std::cerr,
       link::session_directory(),
       link::open_lcm,
       {},
       {{"doctor", "Look whether this host suits the framework, and what to type (no task needed)",
         ui::run_doctor},
        {"explain", "Say what an error means, what it mostly comes from, what to do (no task needed)",
         ui::run_explain},
        {"view", "Show a running task, or a run folder, as a web page on this host", view::run_view},
        {"stability", "Tell which contact the force law bears (no task needed)", edp::run_stability}}});
}
