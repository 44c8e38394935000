// Least squares: a ball from points that touched it, and the pose between two frames from points that both know.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "base/pose.hpp"

namespace mrroc::calibrate_cell {

/// A ball, as the middles of a tip that touched it say.
struct BallFit {
  Vector3 centre{Vector3::Zero()};  ///< in the frame of the points [m]
  double radius{};                  ///< of ball and tip together, less what both gave way [m]
  double rms{};  ///< distance of the points from the sphere, per point that is too many [m]; 0: there is none
};

/// Minimises the squared distances of the points from a sphere by Gauss-Newton.
/// @param points  middles of the tip in contact [m]
/// @param near    where the ball is about, in the same frame [m] @param radius  about, of ball and tip together [m]
/// @return the ball, or nothing: fewer than four points; points that leave a direction open, as those of one plane do;
///         numbers that are not finite
[[nodiscard]] std::optional<BallFit> fit_ball(std::span<const Vector3> points, const Vector3& near,
                                              double radius);

/// Pose between two frames.
struct PoseFit {
  Pose T_AB;                      ///< B in A
  std::vector<double> residuals;  ///< distance of each point in A from where that of B comes to lie [m]
  double rms{};                   ///< of them [m]
};

/// Minimises the squared distances (Kabsch 1976, Umeyama 1991, without a scale).
/// @param in_A,in_B  the same points in both frames, in the same order [m]
/// @return the pose, or nothing: fewer than three points; points on a line, about which the frames might turn
[[nodiscard]] std::optional<PoseFit> fit_pose(std::span<const Vector3> in_A, std::span<const Vector3> in_B);

/// How far two poses are apart.
struct PoseDistance {
  double mm{};   ///< of their origins [mm]
  double deg{};  ///< angle of the turn between them [degrees]
};
/// @return between A and B, given in the same frame
[[nodiscard]] PoseDistance distance(const Pose& A, const Pose& B);

}  // namespace mrroc::calibrate_cell
