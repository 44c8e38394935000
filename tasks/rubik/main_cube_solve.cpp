#include <iostream>

#include "tasks/rubik/solve_command.hpp"

int main(int argc, char** argv) {
  return mrroc::rubik::run_cube_solve(argc, argv, {std::cin, std::cout, std::cerr});
}
