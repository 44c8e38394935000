// The motion that most matches agree on. Only for the sources of this folder.
#pragma once
#include <optional>
#include <vector>

#include "vsp/odometry/matching.hpp"

namespace mrroc::vsp {

/// Random sample consensus (Fischler and Bolles, 1981): motions from three matches each by the perspective three-point
/// problem in the left picture, judged by all matches in both. At most 100 samples, always the same ones.
/// @return motion of the platform, B at the second pair in B at the first, with the most inliers; nothing when it has less
///         than six
std::optional<Pose> consensus(const StereoRig& rig, const std::vector<StereoMatch>& matches);

/// @return numbers of the matches that are seen within 1.5 pixel of where the motion A says, in either picture
std::vector<std::size_t> inliers(const StereoRig& rig, const std::vector<StereoMatch>& matches,
                                 const Pose& A);

}  // namespace mrroc::vsp
