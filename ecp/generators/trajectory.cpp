#include "ecp/generators/trajectory.hpp"

#include <cmath>

#include "base/representation.hpp"

namespace mrroc::ecp {
namespace {

/// A duration that is longer than a whole number of macrosteps by rounding alone is that number.
constexpr double kRounding = 1e-9;

PoseNumbers numbers_of(const Coordinates& q) { return numbers_from_axes(q); }

Pose pose_of(Representation space, const Coordinates& q) {
  return pose_from_numbers(space, numbers_of(q)).value_or(Pose{});
}

}  // namespace

Trajectory::Trajectory(std::shared_ptr<const Curve> curve, const Coding& coding, const Pacing& pacing)
    : curve_(std::move(curve)), coding_(coding), pacing_(pacing) {
  const auto demand = [](bool good, const char* what) {
    if (!good) throw FaultError(FaultCode::bad_trajectory, what);
  };
  demand(curve_ != nullptr, "there is no curve");
  demand(pacing.dt > 0 && pacing.n_s >= 1 && pacing.n_s <= kMaxSteps, "a macrostep needs 1 to 1000 steps");
  demand(pacing.n_Q >= 1 && pacing.n_Q <= pacing.n_s + 1, "n_Q must lie between 1 and n_s + 1");
  demand(coding.space != Representation::frame, "a curve has coordinates, not matrices");
  demand(
      coding.mu == Interpolation::mim || (coding.mu == Interpolation::tcim_pose && !per_axis(coding.space)),
      "motors and joints are interpolated with MIM, poses with MIM or TCIM-POSE");
  macrosteps_ =
      static_cast<std::int64_t>(std::ceil(curve_->duration() / pacing.macrostep_s() * (1 - kRounding)));
}

Coordinates Trajectory::set_position(std::int64_t k) const {
  return curve_->at(k >= macrosteps_ ? curve_->duration() : static_cast<double>(k) * pacing_.macrostep_s());
}

PoseNumbers Trajectory::increment(std::int64_t k) const {
  const Coordinates from = set_position(k);
  const Coordinates to = set_position(k + 1);
  if (per_axis(coding_.space)) return numbers_of(to - from);
  return numbers_from_pose(coding_.space,
                           pose_of(coding_.space, from).inverse() * pose_of(coding_.space, to));
}

ArmCommand Trajectory::command(std::int64_t k) const {
  ArmCommand command;
  command.mu = coding_.mu;
  command.representation = coding_.space;
  command.reference = coding_.reference;
  command.pose = coding_.reference == Reference::relative ? increment(k) : numbers_of(set_position(k + 1));
  command.n_s = pacing_.n_s;
  command.n_Q = pacing_.n_Q;
  return command;
}

}  // namespace mrroc::ecp
