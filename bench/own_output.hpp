// Reserves standard output for a program's result alone.
#pragma once
#include <string_view>

namespace mrroc::bench {

/// While it lives, what this program and those that it starts print on their standard output goes to the standard
/// error; only write() reaches what was the standard output.
class OwnOutput {
 public:
  OwnOutput();
  ~OwnOutput();
  OwnOutput(const OwnOutput&) = delete;
  OwnOutput& operator=(const OwnOutput&) = delete;

  /// @throws FaultError cannot_write
  void write(std::string_view text) const;

 private:
  int file_;
};

}  // namespace mrroc::bench
