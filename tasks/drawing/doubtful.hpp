// Checks that a memory does not contradict itself: pen states against the height of the pen. Needs no truth.
#pragma once
#include "tasks/drawing/recording.hpp"

namespace mrroc::drawing {

/// The path of the pen is summed up from the nodes' velocities, and a plane laid through the nodes on the paper by least
/// squares. Doubtful is a run of nodes on the paper whose mean is farther from that plane than kOffPaper, and a run in
/// the air in which the pen moves farther than kSmear along the paper while it is lower than kLowTravel above it.
/// @param recording  taught with a pen of constant orientation
/// @return the number of doubtful runs
[[nodiscard]] int doubtful_strokes(const Recording& recording);

inline constexpr double kOffPaper = 0.003;   ///< soft paper gives way by half of it [m]
inline constexpr double kLowTravel = 0.001;  ///< [m]
inline constexpr double kSmear = 0.003;      ///< [m]

}  // namespace mrroc::drawing
