#include "tasks/ball/law.hpp"

#include <algorithm>

#include "ecp/generators/force.hpp"
#include "tasks/ball/path.hpp"

namespace mrroc::ball {
namespace {

constexpr double kPlaceGain = 2;          // of an error of the place [1/s]
constexpr double kTurnGain = 2;           // of an error of the orientation [1/s]
constexpr double kReturnGain = 1;         // of the middle between the palms along the line [1/s]
constexpr double kShareMobility = 0.001;  // [m/s/N]
constexpr double kShareReturn = 0.3;      // [1/s]
constexpr double kMostShift = 0.003;      // [m]
constexpr double kYieldMobility = 0.004;  // [m/s/N]
constexpr double kYieldReturn = 1;        // [1/s]
constexpr double kMostYield = 0.05;       // [m]
constexpr double kNoise = 1.5;            // of forces across that mean nothing [N]

double seconds() { return kPacing.macrostep_s(); }

Vector3 limited(const Vector3& v, double most) {
  return v.norm() > most ? Vector3(most * v.normalized()) : v;
}

}  // namespace

PairState pair_state(const Parameters& k, const std::array<Report, kArms>& reports) {
  PairState s;
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    s.T_UE[arm] = k.T_UB[arm] * pose_of(reports[arm]);
    const Vector3 force = s.T_UE[arm].R * reports[arm].F_a.linear();
    s.press[arm] = reports[arm].F_a[Axis::z];
    s.across[arm] = force - kLine * kLine.dot(force);
  }
  s.distance = kLine.dot(s.T_UE[0].p - s.T_UE[1].p);
  return s;
}

double contact_force(const PairState& s, double closed) {
  const auto [least, most] = std::minmax(s.press[0], s.press[1]);
  return s.distance < closed ? most : least;
}

TaskFrameCommand hold_place(std::size_t arm, const Pose& T_UE, const PalmGoal& goal) {
  const Vector3 v = T_UE.R.transpose() * (goal.velocity + kPlaceGain * (goal.place - T_UE.p));
  const Vector3 w = kTurnGain * angle_axis_from_rotation(T_UE.R.transpose() * palm_orientation(arm));
  TaskFrameCommand frame;
  frame.x = u(v.x());
  frame.y = u(v.y());
  frame.ax = u(w.x());
  frame.ay = u(w.y());
  frame.az = u(w.z());
  return frame;
}

AxisCommand press(double force) { return c(force, ecp::kInertia, ecp::kMobility); }

AxisCommand press_in_place(double force, const PairState& state, const Vector3& goal) {
  const double off = -kLine.dot(goal - (state.T_UE[0].p + state.T_UE[1].p) / 2);
  return c(force + kReturnGain * off / ecp::kMobility, ecp::kInertia, ecp::kMobility);
}

Vector3 share_load(const Vector3& shift, const PairState& state) {
  const Vector3 more = state.across[1] - state.across[0];
  return limited(shift - seconds() * (kShareMobility * more + kShareReturn * shift), kMostShift);
}

Vector3 yield(const Vector3& yielded, const Vector3& pushed) {
  return limited(yielded + seconds() * (kYieldMobility * pushed - kYieldReturn * yielded), kMostYield);
}

Vector3 pushed_by_hand(const PairState& state, double load) {
  const Vector3 pushed = load * Vector3::UnitZ() - state.across[0] - state.across[1];
  const double force = pushed.norm();
  return force > kNoise ? Vector3((1 - kNoise / force) * pushed) : Vector3(Vector3::Zero());
}

}  // namespace mrroc::ball
