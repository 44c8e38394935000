#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "base/cube/facelets.hpp"
#include "base/fault.hpp"
#include "base/text_file.hpp"
#include "bench/figures.hpp"
#include "tasks/rubik/solver/solver.hpp"
#include "tasks/rubik/solver/table_progress.hpp"

namespace mrroc::bench {
namespace {

using namespace rubik;
using std::chrono::steady_clock;

constexpr std::size_t kLargestFile = 1 << 20;

double seconds_since(steady_clock::time_point begin) {
  return std::chrono::duration<double>(steady_clock::now() - begin).count();
}

std::vector<Cube> read_cubes(const std::string& name) {
  const std::filesystem::path file = std::filesystem::path(MRROC_BENCH_CUBES) / name;
  const std::string text = read_text_file(file, kLargestFile);
  std::vector<Cube> cubes;
  for (Lines lines(text, name); !lines.done();)
    cubes.push_back(cube_from_facelets(lines.next().substr(0, kFacelets)));
  return cubes;
}

const Moves& verified(const Cube& cube, const Solution& solution) {
  if (after(cube, solution.moves) != Cube{})
    throw FaultError(FaultCode::internal_error, "the solver gave turns that do not solve the cube");
  return solution.moves;
}

/// @return mean number of turns that the two-phase algorithm needs, with one thread
double mean_length(const CubeSolver& solver, const std::vector<Cube>& cubes,
                   std::chrono::milliseconds budget) {
  std::size_t turns = 0;
  for (const Cube& cube : cubes)
    turns += verified(cube, solver.solve_in_two_phases(cube, {.budget = budget})).size();
  return static_cast<double>(turns) / static_cast<double>(cubes.size());
}

/// @return mean time of a proven shortest solution, with one thread [s]
double mean_optimal_time(const CubeSolver& solver, const std::vector<Cube>& cubes) {
  const steady_clock::time_point begin = steady_clock::now();
  for (const Cube& cube : cubes)
    if (const Solution s = solver.solve_optimally(cube, {}); !verified(cube, s).empty() && !s.optimal())
      throw FaultError(FaultCode::internal_error, "a solution is not proven to be a shortest one");
  return seconds_since(begin) / static_cast<double>(cubes.size());
}

void measure(TableSet set, const std::string& suffix, const std::string& tables, Figures& figures) {
  using std::chrono_literals::operator""ms;
  constexpr int kThreadsForTables = 2;
  TableProgress progress(stderr);
  const steady_clock::time_point begin = steady_clock::now();
  const CubeSolver solver(set, table_folder(), kThreadsForTables, progress.watch());
  figures.push_back({"cube_tables_s" + suffix, seconds_since(begin), "s",
                     "to open the " + tables + " tables, or to make them"});
  const std::vector<Cube> cubes = read_cubes("random_400.txt");
  static_cast<void>(mean_length(solver, {cubes.begin(), cubes.begin() + 20}, 10ms));  // warms the caches
  figures.push_back({"two_phase_len_10ms" + suffix, mean_length(solver, cubes, 10ms), "turns",
                     "mean of 400 random cubes, " + tables + " tables"});
  figures.push_back({"two_phase_len_100ms" + suffix, mean_length(solver, cubes, 100ms), "turns", "the same"});
  figures.push_back({"optimal14_s" + suffix, mean_optimal_time(solver, read_cubes("len14.txt")), "s",
                     "proven shortest, 14 turns, mean of 40"});
  if (set == TableSet::large)
    figures.push_back({"optimal16_s" + suffix, mean_optimal_time(solver, read_cubes("len16.txt")), "s",
                       "proven shortest, 16 turns, mean of 40"});
}

}  // namespace

Figures run_solver_group() {
  Figures figures;
  measure(TableSet::standard, "_default", "default", figures);
  measure(TableSet::large, "", "large", figures);
  return figures;
}

}  // namespace mrroc::bench
