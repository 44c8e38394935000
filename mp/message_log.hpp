// messages.log: the messages of a run's processes to people, one line each.
#pragma once
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/fault.hpp"

namespace mrroc::mp {

/// A line has the wall time since the beginning, process, class, code and text.
class MessageLog {
 public:
  /// @param file  is made anew
  explicit MessageLog(const std::filesystem::path& file) : out_(file) {}

  /// Writes a line at once. @param code  none: information
  void write(std::string_view process, std::string_view text, FaultCode code);

  /// @return the last line, with its process
  [[nodiscard]] const std::string& last() const { return last_; }
  /// @return code of the last line; none: information
  [[nodiscard]] FaultCode last_code() const { return last_code_; }

 private:
  using Clock = std::chrono::steady_clock;
  std::ofstream out_;
  Clock::time_point begun_{Clock::now()};
  std::string last_;
  FaultCode last_code_{FaultCode::none};
};

}  // namespace mrroc::mp
