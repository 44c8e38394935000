#include "tasks/rubik/solve_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"
#include "base/text_file.hpp"
#include "tasks/rubik/cube/facelets.hpp"
#include "tasks/rubik/cube/move.hpp"
#include "tasks/rubik/solver/solver.hpp"
#include "tasks/rubik/solver/table_progress.hpp"

namespace mrroc::rubik {
namespace {

constexpr const char* kAbout =
    "Solves Rubik's cubes. Each gives a line: the number of turns, then the turns.\n"
    "A cube is given as 54 facelets in the order U R F D L B, or as the turns that scramble it.";

constexpr const char* kFooter =
    "\nExamples:\n"
    "  cube_solve \"R U' F2\"\n"
    "  cube_solve --budget-ms 1000 DDFBUFULLBRRURRLDRBUUFFFFBBRDDRDLFRDLLRULLUUDUFFDBBBBL\n"
    "  cube_solve --optimal --tables large --file cubes.txt     a cube a line; # begins a remark\n"
    "\nTables are made when they are first needed and kept in $XDG_CACHE_HOME/mrroc or ~/.cache/mrroc:\n"
    "  default  130 MB, seconds     large  3.2 GB, minutes\n"
    "\nExit status: 0 all solved, 2 bad usage or an impossible cube, 3 system error";

constexpr std::size_t kLargestFile = std::size_t{1} << 28;
constexpr int kDefaultBudget = 100;  // [ms]

struct Options {
  std::vector<std::string> words;
  std::string file;
  std::string folder;
  std::string tables{"default"};
  int budget{};  ///< [ms]; 0: not given
  int threads{1};
  bool optimal{};
};

/// Something to solve, and where it was given.
struct Item {
  std::string text;
  int line{};  ///< of the file; 0: the command line
};

/// @return whether the word is meant as facelets: turns in one word without a space are shorter
bool looks_like_facelets(std::string_view word) {
  constexpr std::size_t kShortest = 40;
  return word.size() >= kShortest && word.find_first_of("'23,") == std::string_view::npos;
}

/// @throws FaultError bad_cube
Cube read_cube(const std::string& text) {
  const std::string word = text.substr(0, text.find_first_of(" \t\r"));
  return looks_like_facelets(word) ? cube_from_facelets(word) : after({}, parse_moves(text));
}

std::vector<Item> read_items(const Options& options) {
  if (options.file.empty()) {
    std::string text;
    for (const std::string& word : options.words) text += (text.empty() ? "" : " ") + word;
    return {{text, 0}};
  }
  std::vector<Item> items;
  const std::string content = read_text_file(options.file, kLargestFile);
  int line = 0;
  for (std::size_t begin = 0; begin < content.size();) {
    const std::size_t end = std::min(content.find('\n', begin), content.size());
    std::string text = content.substr(begin, end - begin);
    begin = end + 1;
    ++line;
    text.resize(std::min(text.find('#'), text.size()));
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first != std::string::npos) items.push_back({text.substr(first), line});
  }
  return items;
}

std::string place_of(const Item& item) { return item.line > 0 ? fmt::format("line {}: ", item.line) : ""; }

int solve_all(const Options& options, TableSet standard, std::ostream& out, std::ostream& err) {
  const std::vector<Item> items = read_items(options);
  TableProgress progress(stderr);
  const CubeSolver solver(options.tables == "large" ? TableSet::large : standard,
                          options.folder.empty() ? table_folder() : std::filesystem::path(options.folder),
                          options.threads, progress.watch());
  SearchLimits limits{.threads = options.threads};
  if (options.budget > 0 || !options.optimal)
    limits.budget = std::chrono::milliseconds(options.budget > 0 ? options.budget : kDefaultBudget);
  int status = 0;
  for (const Item& item : items) {
    try {
      const Cube cube = read_cube(item.text);
      const Solution s = options.optimal ? solver.solve_optimally(cube, limits) : solver.solve(cube, limits);
      out << fmt::format("{}{}{}\n", s.moves.size(), s.moves.empty() ? "" : " ", to_string(s.moves))
          << std::flush;
      if (options.optimal && !s.optimal())
        err << fmt::format("{}not proven to be a shortest solution: at least {} turns are needed\n",
                           place_of(item), s.lower_bound);
    } catch (const FaultError& e) {
      const FaultError placed(e.fault().code, place_of(item) + e.what(), std::string(e.remedy()));
      err << placed.error_line() << '\n';
      status = exit_status(e.fault().code);
    }
  }
  return status;
}

}  // namespace

int run_cube_solve(int argc, const char* const* argv, std::ostream& out, std::ostream& err,
                   TableSet standard) {
  CLI::App app{kAbout};
  app.name("cube_solve");
  app.footer(kFooter);
  Options options;
  auto* cube = app.add_option("cube", options.words, "facelets or turns")->type_name("FACELETS|TURNS");
  app.add_option("--file", options.file, "cubes, one a line; what follows facelets is not read")
      ->type_name("FILE")
      ->excludes(cube);
  app.add_option("--budget-ms", options.budget, "time for each cube (default 100; with --optimal: none)")
      ->check(CLI::Range(1, 86'400'000))
      ->type_name("N");
  app.add_flag("--optimal", options.optimal,
               "a shortest solution, proven; with a budget only up to 14 turns for certain");
  app.add_option("--threads", options.threads, "for searching and for making tables (default 1)")
      ->check(CLI::Range(1, 256))
      ->type_name("N");
  app.add_option("--tables", options.tables, "large: shorter solutions, and shortest ones sooner")
      ->check(CLI::IsMember({"default", "large"}))
      ->type_name("default|large");
  app.add_option("--tables-dir", options.folder, "where tables are kept")->type_name("DIR");
  try {
    app.parse(argc, argv);
    if (options.file.empty() && options.words.empty())
      throw FaultError(FaultCode::bad_usage, "no cube was given");
    return solve_all(options, standard, out, err);
  } catch (const CLI::CallForHelp& e) {
    return app.exit(e, out, err);
  } catch (const CLI::ParseError& e) {
    err << FaultError(FaultCode::bad_usage, e.what()).error_line() << '\n';
    return 2;
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
