// Shows the progress of making tables on standard error.
#pragma once
#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>

#include "tasks/rubik/solver/tables.hpp"

namespace mrroc::rubik {

/// A terminal sees one line that is kept up to date, anything else two lines for each table that takes more than a
/// second. Tables that are read from their files are not mentioned.
class TableProgress {
 public:
  /// @param stream  usually stderr; outlives this object
  explicit TableProgress(std::FILE* stream);

  /// @return what Tables wants; this object must outlive it
  [[nodiscard]] TableWatch watch();

 private:
  void show(std::string_view table, double part);

  std::mutex mutex_;  ///< several threads make a table
  std::FILE* stream_;
  bool terminal_;
  int shown_{-1};     ///< per cent
  bool announced_{};  ///< not on a terminal
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace mrroc::rubik
