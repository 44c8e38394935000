#include "tasks/rubik/solve_command.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <istream>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/command_line.hpp"
#include "base/cube/character.hpp"
#include "base/cube/cube_text.hpp"
#include "base/fault.hpp"
#include "base/text_file.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/solver/solver.hpp"
#include "tasks/rubik/solver/table_progress.hpp"

namespace mrroc::rubik {
namespace {

constexpr const char* kAbout =
    "Solves Rubik's cubes. Each gives a line: the number of turns, then the turns.\n"
    "A cube is given as 54 facelets in the order U R F D L B, or as the turns that scramble it.\n\n"
    "Iterative-deepening A* looks for a solution of up to 14 turns first, which is proven to be a shortest "
    "one; if\n"
    "there is none, or time is up, the two-phase algorithm finds a short one and improves it until its time "
    "is up.\n"
    "Which of them it was, and whether the solution is proven to be shortest, is told on standard error.";

constexpr const char* kFooter =
    "\nExamples:\n"
    "  cube_solve \"R U' F2\"\n"
    "  cube_solve --budget-ms 1000 DDFBUFULLBRRURRLDRBUUFFFFBBRDDRDLFRDLLRULLUUDUFFDBBBBL\n"
    "  cube_solve --optimal --tables large --file cubes.txt     a cube a line; # begins a remark\n"
    "\nBlanks and ends of lines within facelets do not count.\n"
    "\nTables are made when they are first needed and kept in $XDG_CACHE_HOME/mrroc or ~/.cache/mrroc:\n"
    "  default  130 MB, seconds     large  3.2 GB, minutes\n"
    "\nExit status: 0 all solved, 2 bad usage or an impossible cube, 3 system error";

constexpr std::size_t kLargestFile = std::size_t{1} << 28;
constexpr std::chrono::milliseconds kShortestBudget{2000};
constexpr std::chrono::milliseconds kTwoPhaseBudget{100};

struct Options {
  std::vector<std::string> words;
  std::string file;
  std::string folder;
  std::string tables{"default"};
  int budget{};  ///< [ms]; 0: not given
  int threads{1};
  bool optimal{};
};

/// @return the limits of CubeSolver::solve()
SolveLimits solve_limits(const Options& options) {
  SolveLimits limits;
  limits.shortest = {.budget = kShortestBudget, .threads = options.threads};
  limits.two_phase = {.budget = kTwoPhaseBudget, .threads = options.threads};
  if (options.budget > 0) {
    limits.both = limits.two_phase.budget = std::chrono::milliseconds(options.budget);
    limits.shortest.budget = limits.both / 2;
  }
  return limits;
}

SearchLimits optimal_limits(const Options& options) {
  SearchLimits limits{.threads = options.threads};
  if (options.budget > 0) limits.budget = std::chrono::milliseconds(options.budget);
  return limits;
}

/// Solves one cube after the other; the tables are opened for the first one that is possible.
class Solving {
 public:
  Solving(const Options& options, TableSet standard, std::ostream& out, std::ostream& err)
      : options_(options), standard_(standard), out_(out), err_(err) {}

  /// @throws FaultError bad_usage, bad_cube
  void solve_words() {
    std::string text;
    for (const std::string& word : options_.words) text += (text.empty() ? "" : " ") + word;
    if (is_blank(text)) throw FaultError(FaultCode::bad_usage, "no cube was given", kHowToGive);
    solve(read_cube(text), "");
  }

  /// @param name  for people @throws FaultError bad_usage: there is no cube in it
  void solve_lines(std::istream& in, const std::string& name) {
    int number = 0, cubes = 0;
    for (std::string line; std::getline(in, line);) {
      ++number;
      line.resize(std::min(line.find('#'), line.size()));
      if (is_blank(line)) continue;
      ++cubes;
      const std::string place = fmt::format("line {}: ", number);
      try {
        solve(read_cube_line(line), place);
      } catch (const FaultError& e) {
        const FaultError placed(e.fault().code, place + e.what(), std::string(e.remedy()));
        err_ << placed.error_line() << '\n';
        status_ = exit_status(e.fault().code);
      }
    }
    if (cubes == 0)
      throw FaultError(FaultCode::bad_usage, fmt::format("there is no cube in {}", name), kHowToGive);
  }

  [[nodiscard]] int status() const { return status_; }

 private:
  static constexpr const char* kHowToGive = "give facelets or turns, in a file a cube a line";

  static bool is_blank(std::string_view text) {
    return text.find_first_not_of(kBlanks) == std::string_view::npos;
  }

  /// @param place  where the cube was given, for people
  void solve(const Cube& cube, const std::string& place) {
    const CubeSolver& with = solver();
    const Solution s = options_.optimal ? with.solve_optimally(cube, optimal_limits(options_))
                                        : with.solve(cube, solve_limits(options_));
    out_ << fmt::format("{}{}{}\n", s.moves.size(), s.moves.empty() ? "" : " ", to_string(s.moves))
         << std::flush;
    err_ << place << describe(s) << '\n';
  }

  const CubeSolver& solver() {
    if (!solver_)
      solver_.emplace(options_.tables == "large" ? TableSet::large : standard_,
                      options_.folder.empty() ? table_folder() : std::filesystem::path(options_.folder),
                      options_.threads, progress_.watch());
    return *solver_;
  }

  const Options& options_;
  const TableSet standard_;
  std::ostream& out_;
  std::ostream& err_;
  TableProgress progress_{stderr};
  std::optional<CubeSolver> solver_;
  int status_{};
};

int solve_all(const Options& options, TableSet standard, const SolveStreams& streams) {
  Solving solving(options, standard, streams.out, streams.err);
  if (options.file == "-") {
    solving.solve_lines(streams.in, "the standard input");
  } else if (!options.file.empty()) {
    std::istringstream content(read_text_file(options.file, kLargestFile));
    solving.solve_lines(content, options.file);
  } else {
    solving.solve_words();
  }
  return solving.status();
}

}  // namespace

int run_cube_solve(int argc, const char* const* argv, const SolveStreams& streams, TableSet standard) {
  std::ostream& err = streams.err;
  CommandLine line(kAbout, "cube_solve");
  line.footer(kFooter);
  Options options;
  const Option cube = line.option("cube", options.words, "facelets or turns").type_name("FACELETS|TURNS");
  line.option("--file", options.file,
              "cubes, one a line, - for the standard input; what follows facelets is not read")
      .type_name("FILE")
      .excludes(cube);
  line.option(
          "--budget-ms", options.budget,
          "time for each cube, at most half of it for IDA* (default: 2000 for IDA*, then 100 for two-phase; "
          "with --optimal: none)")
      .range(1, 86'400'000)
      .type_name("N");
  line.flag("--optimal", options.optimal,
            "IDA* until a solution is proven to be shortest; with a budget only up to 14 turns for certain");
  line.option("--threads", options.threads, "for searching and for making tables (default 1)")
      .range(1, 256)
      .type_name("N");
  line.option("--tables", options.tables, "large: shorter solutions, and shortest ones sooner")
      .one_of({"default", "large"})
      .type_name("default|large");
  line.option("--tables-dir", options.folder, "where tables are kept").type_name("DIR");
  try {
    if (const auto help = line.parse_or_help(
            argc, argv, {"cube_solve --file cubes.txt", "cube_solve \"R U' F2\" --budget-ms 10"})) {
      streams.out << *help;
      return 0;
    }
    return solve_all(options, standard, streams);
  } catch (const FileError& e) {
    err << FaultError(FaultCode::bad_usage, e.wrong(), e.remedy()).error_line() << '\n';
    return 2;
  } catch (const FaultError& e) {
    err << e.error_line() << '\n';
    return exit_status(e.fault().code);
  } catch (const std::bad_alloc&) {
    err << FaultError(FaultCode::internal_error, "there is not enough memory for the tables",
                      "use --tables default")
               .error_line()
        << '\n';
    return 3;
  }
}

}  // namespace mrroc::rubik
