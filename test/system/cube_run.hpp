// A run of the cube's task, and what it has left.
#pragma once
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "test/system/started_task.hpp"
#include "test/system/tables.hpp"

namespace mrroc::test {

/// One turn of the face that the track arm shows to the other one.
inline const std::vector<std::string> kOneTurn{"--scramble", "U'",    "--eyes",
                                               "none",       "--set", "task.tables=small"};

/// The figures in the folder of a run.
struct CubeFigures {
  explicit CubeFigures(std::filesystem::path run_folder) : run(std::move(run_folder)) {
    if (std::filesystem::exists(run / "summary.json")) told = summary(run);
  }
  [[nodiscard]] double figure(const std::string& key) const { return test::figure(told, key); }
  /// @return code of the fault; empty: there was none
  [[nodiscard]] std::string fault() const {
    return told.contains("fault") && told.at("fault").is_object()
               ? told.at("fault").at("code").get<std::string>()
               : "";
  }
  [[nodiscard]] std::string text(const std::string& file) const {
    std::ifstream in(run / file);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }
  /// @return largest speed of both hands in the last macrostep that was written down [m/s], turning as if at 0.1 m
  [[nodiscard]] double speed_at_the_end() const {
    double most = 0;
    for (const char* arm : {"arm1.csv", "arm2.csv"}) {
      const auto rows = read_table(run / arm, kArmHeading);
      if (rows.size() < 2) return NAN;
      const Row &last = rows.back(), &before = rows[rows.size() - 2];
      const double dt = last[kT] - before[kT];
      for (int k = kX; k <= kAz; ++k) {
        const auto at = static_cast<std::size_t>(k);
        most = std::max(most, std::abs(last[at] - before[at]) * (k < kAx ? 1 : 0.1) / dt);
      }
    }
    return most;
  }

  std::filesystem::path run;
  nlohmann::json told;
};

/// Runs the task to its end in a folder of its own.
struct CubeRun {
  explicit CubeRun(const std::vector<std::string>& arguments,
                   const std::vector<std::string>& turns = kOneTurn)
      : ended(
            test::run(folder, "rubik", words({turns, arguments, {"--run-dir", (folder / "run").string()}}))),
        left(folder / "run") {}
  [[nodiscard]] double figure(const std::string& key) const { return left.figure(key); }
  [[nodiscard]] bool said(const std::string& words) const {
    return ended.all().find(words) != std::string::npos;
  }

  Folder folder;
  Ended ended;
  CubeFigures left;
};

}  // namespace mrroc::test
