// When something is broken on purpose, in steps.
#pragma once
#include <cstdint>
#include <string>

#include "base/config.hpp"

namespace mrroc {

/// Steps from, from + 1, ... to - 1; none by default.
struct StepInterval {
  std::int64_t from{};  ///< first one
  std::int64_t to{};    ///< first one after

  /// @return whether a step is one of them
  [[nodiscard]] constexpr bool contains(std::int64_t step) const noexcept {
    return step >= from && step < to;
  }
};

/// @param config  as a whole, not a section of it  @param key  of a list [from, to]; none of an empty list, or without the key
/// @throws ConfigError, FaultError  bad_configuration: it is no list of two whole numbers, the second the larger one
[[nodiscard]] StepInterval read_step_interval(const Config& config, const std::string& key);

}  // namespace mrroc
