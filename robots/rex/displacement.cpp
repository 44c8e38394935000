#include "robots/rex/displacement.hpp"

#include "robots/rex/planar.hpp"

namespace mrroc::rex {
namespace {

constexpr double kFar = 0.015;        // [m]
constexpr double kFarTurned = 0.015;  // [rad]

/// @return whether the map has told of no other stage
bool after_silence(const StageWindow& window, int k) noexcept {
  for (int i = 0; i < window.size(); ++i)
    if (i != k && window[i].map.valid) return false;
  return true;
}

}  // namespace

std::optional<PlanarPose> displacement_at(const StageWindow& window, int k, const StageVector& z) noexcept {
  if (!after_silence(window, k)) return std::nullopt;
  const Eigen::Vector3d believed = pose_of_body(z, window.centre(), window[k].map_delay).value;
  const Eigen::Vector3d seen = window[k].map.value;
  const Eigen::Vector2d away = seen.head<2>() - believed.head<2>();
  const double turn = wrap_angle(seen[2] - believed[2]);
  if (away.norm() <= kFar && std::abs(turn) <= kFarTurned) return std::nullopt;
  const Eigen::Vector2d shift = seen.head<2>() - rotation(turn) * believed.head<2>();
  return PlanarPose{shift.x(), shift.y(), turn};
}

StageVector moved(StageVector z, const PlanarPose& displacement) noexcept {
  for (const int pose : {kPose, kCloneIndex}) {
    const PlanarPose p = chained(displacement, {z[pose], z[pose + 1], z[pose + kHeading]});
    z.segment<3>(pose) << p.x, p.y, p.phi;
  }
  return z;
}

StageBelief moved(StageBelief belief, const PlanarPose& displacement) noexcept {
  StageMatrix J = StageMatrix::Identity();
  J.block<2, 2>(kPose, kPose) = J.block<2, 2>(kCloneIndex, kCloneIndex) = rotation(displacement.phi);
  const StageMatrix JP = J * belief.P;
  belief.P.noalias() = JP * J.transpose();
  belief.z = moved(belief.z, displacement);
  return belief;
}

}  // namespace mrroc::rex
