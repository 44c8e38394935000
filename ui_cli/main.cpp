#include <iostream>

#include "base/link/session.hpp"
#include "ui_cli/commands.hpp"

int main(int argc, char** argv) {
  return mrroc::ui::run(argc, argv,
                        {std::cout, std::cerr, mrroc::link::session_directory(), mrroc::link::open_lcm, {}});
}
