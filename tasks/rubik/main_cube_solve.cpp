#include <iostream>

#include "base/standard_files.hpp"
#include "tasks/rubik/solve_command.hpp"

int main(int argc, char** argv) {
  const int status = mrroc::rubik::run_cube_solve(argc, argv, {std::cin, std::cout, std::cerr});
  return mrroc::end_standard_output(status);
}
