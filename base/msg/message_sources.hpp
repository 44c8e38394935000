// The texts of all message definitions, collected by the build.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

namespace mrroc {

/// One file base/msg/NAME.lcm.
struct MessageSource {
  std::int64_t fingerprint{};   ///< of the generated type
  std::string_view definition;  ///< content of the file
};

/// @return all of them; made by cmake/lcm.cmake
[[nodiscard]] std::vector<MessageSource> message_sources();

}  // namespace mrroc
