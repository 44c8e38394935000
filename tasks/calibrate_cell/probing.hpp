// How an arm touches balls: in which order, from where, and what it believes of their places meanwhile.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/pose.hpp"

namespace mrroc::calibrate_cell {

/// One way to come to a ball, along an axis of E. E keeps its orientation; its z points out of the tool.
struct Direction {
  Axis axis{Axis::z};  ///< along which the tip moves, one of x, y, z
  double sign{1};      ///< 1 or -1
};
/// In front, then from three sides in turn. The fourth side is that of the stand.
inline constexpr std::array<Direction, 4> kDirections{
    {{Axis::z, 1}, {Axis::y, -1}, {Axis::x, -1}, {Axis::y, 1}}};
/// Each ball is touched once around where it is believed, and once more around where it was found.
inline constexpr std::size_t kRounds = 2;
inline constexpr std::size_t kTouchesPerBall = kRounds * kDirections.size();  ///< of one arm

/// Balls, and how they are touched.
struct ProbePlan {
  std::vector<Vector3> balls;  ///< where they are believed, in the arm's base [m]
  double ball_radius{0.03};    ///< [m]
  double tip_radius{0.01};     ///< of the ball at the end of the tool [m]
  double wide_gap{0.025};      ///< left to a ball that is believed [m]; more than it may stand elsewhere
  double narrow_gap{0.01};     ///< left to one that was found [m]
  double beyond{0.03};         ///< how far beyond the surface it is looked for [m]
  double speed{0.01};          ///< of a touch [m/s]
  double force{4};             ///< at which it settles [N]
  double inertia{5};           ///< I of the touch [kg]
  int settling{15};            ///< macrosteps in contact before the pose is read
  int readings{25};            ///< macrosteps over which it is averaged

  friend bool operator==(const ProbePlan&, const ProbePlan&) = default;
};

/// A touch of a ball.
struct Touch {
  Vector3 middle{Vector3::Zero()};  ///< of the tip in contact, in the arm's base [m]
  Vector3 along{Vector3::UnitZ()};  ///< unit vector in which it came

  friend bool operator==(const Touch&, const Touch&) = default;
};

/// @return number of touches of one arm
[[nodiscard]] inline std::size_t touches(const ProbePlan& plan) {
  return plan.balls.size() * kTouchesPerBall;
}
/// @param n  number of a touch, from 0 @return how it comes
[[nodiscard]] inline const Direction& direction(std::size_t n) { return kDirections[n % kDirections.size()]; }
/// @return unit vector of that direction in the base @param R  of E in the base
[[nodiscard]] Vector3 in_base(const Direction& direction, const Matrix3& R);
/// @return the middle of the tip, in the base @param T_0E  of the tip's front in the base
[[nodiscard]] Vector3 middle_of_tip(const ProbePlan& plan, const Pose& T_0E);

/// @param done  touches so far, in order, of the first balls
/// @return where a ball is believed by now, in the base: fitted to its touches; with fewer of them put where each of them
///         says along its way; before the first one where it is told, moved as the balls before
[[nodiscard]] Vector3 believed(const ProbePlan& plan, std::span<const Touch> done, std::size_t ball);

/// @return the way to the beginning of the next touch, poses of E in the base, the present one first: away from the ball,
///         back, across, and forward
/// @param done  as above, fewer than touches(plan) @param T_now  of E
/// @param T_ready  of E, apart from all balls: its orientation is kept, and between balls it is gone back so far
[[nodiscard]] std::vector<Pose> way_to_touch(const ProbePlan& plan, std::span<const Touch> done,
                                             const Pose& T_now, const Pose& T_ready);
/// @return the way from the last touch to where the arm was ready
[[nodiscard]] std::vector<Pose> way_back(const ProbePlan& plan, std::span<const Touch> done,
                                         const Pose& T_now, const Pose& T_ready);
/// @return how far the tip goes along the way of touch n before there is nothing to be touched [m]
[[nodiscard]] double longest_way(const ProbePlan& plan, std::size_t n);

}  // namespace mrroc::calibrate_cell
