#include "base/odometry_support.hpp"

#include <array>
#include <cstddef>

namespace mrroc {

const char* to_words(OdometryFinding finding) noexcept {
  constexpr std::array<const char*, kOdometryFindings> kWords{
      "a motion is measured",
      "there is no pair of pictures before",
      "a camera gives no picture",
      "a picture is the very same as before: a camera is frozen",
      "a picture is nearly black",
      "there is hardly anything to see",
      "what one picture shows is not found in the others",
      "left and right are exchanged",
      "too few points agree on a motion",
      "the points agree too roughly on a motion",
      "the motion is longer than it can be"};
  const auto k = static_cast<std::size_t>(finding);
  return k < kWords.size() ? kWords[k] : "unknown";
}

}  // namespace mrroc
