#include "robots/rex/displacement.hpp"

#include <cmath>

#include "robots/rex/estimate.hpp"
#include "robots/rex/planar.hpp"

namespace mrroc::rex {
namespace {

/// By how much an estimate is away from the map without being displaced.
struct Wandered {
  double position{};  ///< [m]
  double heading{};   ///< [rad]
  double ellipses{};  ///< or so many of its ellipses
};

constexpr Wandered kSilent{.position = 0.015, .heading = 0.015, .ellipses = 1};
constexpr Wandered kBrieflySilent{.position = 0.04, .heading = 0.06, .ellipses = 2};
constexpr int kBrief = 8;  // stages

/// @return how far an estimate may be from the map pose of a stage, for which it is corrected; nullopt: for any
std::optional<Wandered> wanders(const StageWindow& window, int k) noexcept {
  int silent = 0;
  for (int i = 0; i < window.size(); ++i) {
    if (i == k || !window[i].map.valid) continue;
    if (i > k) return std::nullopt;
    silent = k - i;
  }
  if (silent == 0) return kSilent;
  if (silent >= kBrief) return kBrieflySilent;
  return std::nullopt;
}

}  // namespace

std::optional<Displacement> displacement_at(const StageWindow& window, int k, const StageVector& z,
                                            const Eigen::Matrix3d& covariance) noexcept {
  constexpr double kBeyond = 3.29;  // standard deviations: 99.9 % of one number
  const auto wandered = wanders(window, k);
  if (!wandered || !beyond_ellipse(window[k], z, covariance, window.centre(), wandered->ellipses))
    return std::nullopt;
  const PlanarFactor& map = window[k].map;
  const Eigen::Vector3d believed = pose_of_body(z, window.centre(), window[k].map_delay).value;
  const Eigen::Vector2d away = map.value.head<2>() - believed.head<2>();
  const double turned = wrap_angle(map.value[2] - believed[2]);
  if (away.norm() <= wandered->position && std::abs(turned) <= wandered->heading) return std::nullopt;
  // A heading that does not contradict is no turn of the map: its noise would turn all that is believed.
  const bool turns = std::abs(turned) > kBeyond * std::sqrt(covariance(2, 2) + map.covariance(2, 2));
  const double turn = turns ? turned : 0;
  const Eigen::Vector2d shift = map.value.head<2>() - rotation(turn) * believed.head<2>();
  Displacement displacement{.motion = {shift.x(), shift.y(), turn}, .at = map.value.head<2>()};
  displacement.covariance.topLeftCorner<2, 2>() = map.covariance.topLeftCorner<2, 2>();
  if (turns) displacement.covariance = map.covariance;
  return displacement;
}

StageVector moved(StageVector z, const PlanarPose& motion) noexcept {
  for (const int pose : {kPose, kCloneIndex}) {
    const PlanarPose p = chained(motion, {z[pose], z[pose + 1], z[pose + kHeading]});
    z.segment<3>(pose) << p.x, p.y, p.phi;
  }
  return z;
}

StageBelief moved(StageBelief belief, const Displacement& displacement) noexcept {
  StageMatrix J = StageMatrix::Identity();
  J.block<2, 2>(kPose, kPose) = J.block<2, 2>(kCloneIndex, kCloneIndex) = rotation(displacement.motion.phi);
  belief.z = moved(belief.z, displacement.motion);
  Eigen::Matrix<double, kStageStates, 3> G = Eigen::Matrix<double, kStageStates, 3>::Zero();
  for (const int pose : {kPose, kCloneIndex}) {
    G.block<3, 3>(pose, 0).setIdentity();
    G.block<2, 1>(pose, 2) = turned(Eigen::Vector2d(belief.z.segment<2>(pose) - displacement.at));
  }
  const StageMatrix JP = J * belief.P;
  const Eigen::Matrix<double, kStageStates, 3> GR = G * displacement.covariance;
  belief.P.noalias() = JP * J.transpose();
  belief.P.noalias() += GR * G.transpose();
  return belief;
}

}  // namespace mrroc::rex
