// A push under way: the stretches that the pair has been told to drive, where the box is in front of it, and how it goes on.
#pragma once
#include <cstdint>
#include <vector>

#include "tasks/box_push/pushes.hpp"
#include "tasks/box_push/stretches.hpp"

namespace mrroc::box_push {

/// How fast the pair pushes.
struct PushSpeeds {
  double closing{0.03};       ///< until both platforms touch the box [m/s]
  double pushing{0.12};       ///< most [m/s]
  double acceleration{0.06};  ///< [m/s^2]
  double slowing{0.5};        ///< speed for a way that is left [1/s]
  double least{0.02};         ///< before the end [m/s]
};

/// One push. A value: every function gives the next one.
struct PushRun {
  Push push{};                       ///< side, and where the box is to come to
  PlanarPose begin{};                ///< of the pair on M, as it has been told
  std::vector<Stretch> stretches{};  ///< told so far, in their order
  PlanarPose box{};                  ///< of the box in the frame of the pair as it has been told, estimated
  double lag{};  ///< of the box behind the noses as they have been told, in the last reading [m]
  int behind{};  ///< readings in succession with a lag that is too large
};

/// @param pair  where it stands, `gap` before the box
[[nodiscard]] PushRun begin_push(const Push& push, const PlanarPose& pair, const Formation& f);

/// @return where the pair has been told to be in the end
[[nodiscard]] PathPoint end_of(const PushRun& run);
/// @param iterations  before the end of all stretches @return where the pair was told to be then
[[nodiscard]] PlanarPose told_before_end(const PushRun& run, double iterations);

/// The box was seen when that many iterations were left to the end of the stretches. What it lags behind counts as its place in
/// front of the pair; until both platforms push, nothing is learned from it.
[[nodiscard]] PushRun with_reading(const PushRun& run, const PlanarPose& box, double iterations,
                                   const Formation& f);

/// Way by which a box may lag behind where the noses of the pair are told to be [m].
inline constexpr double kMostLag = 0.10;
/// @return whether the box does not go with the pair, as it was seen several times in succession
[[nodiscard]] bool stays_behind(const PushRun& run);

/// @return where the pair is to come to, so that the box comes to its target, as seen from the end of the stretches
[[nodiscard]] PlanarPose left_of(const PushRun& run);

/// The next stretch: at first straight on and slowly, until both platforms touch the box; then steered, and slower the less is
/// left; at last to rest.
[[nodiscard]] PushRun with_next_stretch(const PushRun& run, const Hall& hall, const PushSpeeds& k);

}  // namespace mrroc::box_push
