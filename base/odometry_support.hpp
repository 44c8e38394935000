// What visual odometry saw in two pairs of pictures, and why that is a motion or none.
#pragma once
#include <cstdint>

namespace mrroc {

/// What became of a pair of pictures. Messages carry the numbers.
enum class OdometryFinding : std::uint8_t {
  motion,       ///< it is measured
  no_before,    ///< there is no pair before it
  no_picture,   ///< a camera gave none
  frozen,       ///< a picture is the very same as the one before, or that one was
  dark,         ///< a picture is nearly black
  blank,        ///< hardly any corners
  unmatched,    ///< hardly any corner is found again in the other pictures
  swapped,      ///< points are where they would be if left and right were exchanged
  few_inliers,  ///< hardly any points, or none but in a corner of the picture, agree on a motion
  inexact,      ///< the points agree too roughly
  far           ///< the motion is longer than the platform can have moved
};
/// How many there are.
inline constexpr int kOdometryFindings = 11;

/// @return for a person, e.g. "a picture is nearly black"
[[nodiscard]] const char* to_words(OdometryFinding finding) noexcept;

/// What the last reading rests on. Trivially copyable.
struct OdometrySupport {
  std::int64_t frame{};                                 ///< number of the second pair
  OdometryFinding finding{OdometryFinding::no_before};  ///< motion: the reading is valid
  std::int32_t features{};                              ///< corners of the left picture of the first pair
  std::int32_t matches{};  ///< of them, those that were found in all four pictures
  std::int32_t inliers{};  ///< of them, those that agree on one motion
  std::int32_t cells{};    ///< of the picture in which the inliers lie
  double rms_px{};         ///< root mean square of their reprojection errors [pixel]
};

}  // namespace mrroc
