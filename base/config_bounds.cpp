#include "base/config_bounds.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace mrroc {
namespace {

/// Goes through a text once, over strings and comments.
class Scan {
 public:
  explicit Scan(std::string_view toml) : toml_(toml) {}

  std::optional<ConfigExcess> run() {
    while (at_ < toml_.size()) {
      const char c = toml_[at_];
      if (c == '"' || c == '\'') {
        if (!pass_string(c)) return std::nullopt;
        continue;
      }
      if (c == '#') {
        at_ = std::min(toml_.find('\n', at_), toml_.size());
        continue;
      }
      if (c == '.' && ++dots_ >= kMostKeyParts)
        return excess(fmt::format("a key has over {} parts", kMostKeyParts));
      if ((c == '[' || c == '{') && ++brackets_ > kDeepestBrackets)
        return excess(fmt::format("brackets are nested deeper than {}", kDeepestBrackets));
      if ((c == ']' || c == '}') && brackets_ > 0) --brackets_;
      if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) dots_ = 0;
      ++at_;
    }
    return std::nullopt;
  }

 private:
  /// @return false when the string has no end
  bool pass_string(char quote) {
    const std::string three(3, quote);
    const bool lines = toml_.substr(at_, 3) == three;
    at_ += lines ? 3 : 1;
    while (at_ < toml_.size()) {
      if (toml_[at_] == '\\' && quote == '"') {
        at_ += 2;
      } else if (!lines && toml_[at_] == '\n') {
        return false;
      } else if (!lines && toml_[at_] == quote) {
        ++at_;
        return true;
      } else if (lines && toml_.substr(at_, 3) == three) {
        at_ += 3;
        for (int more = 0; more < 2 && toml_.substr(at_, 1) == three.substr(1, 1); ++more) ++at_;
        return true;
      } else {
        ++at_;
      }
    }
    return false;
  }

  [[nodiscard]] ConfigExcess excess(std::string wrong) const {
    const std::string_view before = toml_.substr(0, at_);
    const std::size_t line_begin = before.rfind('\n') + 1;  // 0 in the first line
    return {1 + static_cast<int>(std::ranges::count(before, '\n')), 1 + static_cast<int>(at_ - line_begin),
            std::move(wrong)};
  }

  std::string_view toml_;
  std::size_t at_{};
  int dots_{};
  int brackets_{};
};

}  // namespace

std::optional<ConfigExcess> config_excess(std::string_view toml) { return Scan(toml).run(); }

}  // namespace mrroc
