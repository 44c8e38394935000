// Limits on the work of reading an SVG document. Internal to the SVG reader.
#pragma once
#include <fmt/core.h>

#include <cstddef>
#include <string>

#include "base/text_file.hpp"

namespace mrroc::drawing::svg {

/// Steps that reading one document may take, about a second's; a drawing with 10,000 points takes one million. A short
/// file can ask for any number: by style rules, all of which are looked at for each element, and by `use`, which repeats
/// what it refers to.
inline constexpr std::size_t kMostWork = 200'000'000;

/// Counts the steps: characters and rules that are looked at.
class Work {
 public:
  /// @param name  the file's, for the error
  explicit Work(std::string name) : name_(std::move(name)) {}

  /// @throws FileError when the document has taken more than kMostWork steps
  void spend(std::size_t steps) {
    spent_ += steps;
    if (spent_ > kMostWork)
      throw FileError(name_, 0,
                      fmt::format("reading it would take over {} million steps", kMostWork / 1'000'000),
                      "use fewer style rules, and fewer <use> of large parts");
  }

 private:
  std::string name_;
  std::size_t spent_{};
};

}  // namespace mrroc::drawing::svg
