#include "robots/rex/displacement.hpp"

#include "robots/rex/planar.hpp"

namespace mrroc::rex {
namespace {

/// By how much the believed pose is away from that of the map.
struct Difference {
  double position{};  ///< [m]
  double heading{};   ///< [rad]
};

constexpr Difference kWandersSilent{.position = 0.015, .heading = 0.015};
constexpr Difference kWandersBriefly{.position = 0.04, .heading = 0.06};
constexpr int kBrief = 8;  // stages

/// @return how far an estimate may be from the map pose of a stage, for which it is corrected; nullopt: for any
std::optional<Difference> wanders(const StageWindow& window, int k) noexcept {
  int silent = 0;
  for (int i = 0; i < window.size(); ++i) {
    if (i == k || !window[i].map.valid) continue;
    if (i > k) return std::nullopt;
    silent = k - i;
  }
  if (silent == 0) return kWandersSilent;
  if (silent >= kBrief) return kWandersBriefly;
  return std::nullopt;
}

}  // namespace

std::optional<PlanarPose> displacement_at(const StageWindow& window, int k, const StageVector& z) noexcept {
  const auto wandered = wanders(window, k);
  if (!wandered) return std::nullopt;
  const Eigen::Vector3d believed = pose_of_body(z, window.centre(), window[k].map_delay).value;
  const Eigen::Vector3d seen = window[k].map.value;
  const Eigen::Vector2d away = seen.head<2>() - believed.head<2>();
  const double turn = wrap_angle(seen[2] - believed[2]);
  if (away.norm() <= wandered->position && std::abs(turn) <= wandered->heading) return std::nullopt;
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
