// Errors of the terminal whose remedy depends on the case.
#pragma once
#include <string>
#include <utility>

#include "base/fault.hpp"

namespace mrroc::ui {

/// An error with its own advice instead of the one in the table of errors.
class Failure : public FaultError {
 public:
  Failure(FaultCode code, const std::string& what, std::string remedy)
      : FaultError(code, what), remedy_(std::move(remedy)) {}

  [[nodiscard]] const std::string& remedy() const noexcept { return remedy_; }
  /// @return `error: CODE: what happened; what to do`
  [[nodiscard]] std::string error_line() const {
    return "error: " + std::string(to_string(fault().code)) + ": " + what() + "; " + remedy_;
  }

 private:
  std::string remedy_;
};

}  // namespace mrroc::ui
