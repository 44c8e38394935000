// The table that a run of the benchmarks prints, and the JSON that it leaves.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/figures.hpp"

namespace mrroc::bench {

/// Figures of all groups and what they were measured with. Two groups may have figures of the same key: the file has the
/// first one under "figures", and all of them by group under "groups".
class Report {
 public:
  /// @param file  where the JSON is written after each group; empty: nowhere
  explicit Report(std::filesystem::path file) : file_(std::move(file)) {}

  /// Takes over what the file already holds, if anything.
  /// @throws FaultError bad_usage the file is something else
  void resume();
  /// @return whether the figures of this group are there already
  [[nodiscard]] bool has(const std::string& group) const;
  /// Adds a group's figures, prints their table and writes the file.
  /// @throws FaultError cannot_write
  void add(const std::string& group, const Figures& figures);
  /// @return the JSON of all groups so far: {"figures", "groups", "context"}
  [[nodiscard]] std::string json() const;

 private:
  std::filesystem::path file_;
  std::vector<std::pair<std::string, std::map<std::string, double>>> groups_;  // as they were measured
};

}  // namespace mrroc::bench
