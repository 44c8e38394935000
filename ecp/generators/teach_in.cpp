#include "ecp/generators/teach_in.hpp"

#include "base/representation.hpp"

namespace mrroc::ecp {
namespace {

/// Forces and poses have the same times; coordinates of poses do not jump.
std::vector<Knot> knots_of(const TaughtPath& taught) {
  std::vector<Knot> knots;
  for (const TaughtPose& p : taught.poses) {
    const Coordinates near =
        knots.empty() ? p.pose : nearest_coordinates(taught.space, p.pose, knots.back().pose);
    knots.push_back({p.t, near});
  }
  return knots;
}

std::vector<Knot> force_knots(const TaughtPath& taught) {
  std::vector<Knot> knots;
  for (const TaughtPose& p : taught.poses) knots.push_back({p.t, p.F.vector()});
  return knots;
}

}  // namespace

TeachIn::TeachIn(Representation space, Reference reference, bool with_force, int axes)
    : space_(space), reference_(reference), with_force_(with_force), numbers_(per_axis(space) ? axes : 6) {}

Coordinates TeachIn::seen_from_first(const Coordinates& pose) const {
  if (reference_ == Reference::absolute) return pose;
  if (per_axis(space_)) return pose - first_;
  const Pose T_first = pose_from_numbers(space_, numbers_from_axes(first_)).value_or(Pose{});
  const Pose T = pose_from_numbers(space_, numbers_from_axes(pose)).value_or(Pose{});
  return axes_from_numbers(numbers_from_pose(space_, T_first.inverse() * T), 6);
}

TeachIn TeachIn::appended(const EffectorReply& reply, double t) const {
  const Coordinates pose = axes_from_numbers(reply.pose, numbers_);
  TeachIn next = *this;
  if (size_ == 0) {
    next.first_t_ = t;
    next.first_ = pose;
  }
  if (!poses_) {
    next.poses_ = std::make_shared<std::vector<TaughtPose>>();
  } else if (poses_->size() != size_) {  // an older version: it goes its own way from here
    next.poses_ = std::make_shared<std::vector<TaughtPose>>(
        poses_->begin(), poses_->begin() + static_cast<std::ptrdiff_t>(size_));
  }
  next.poses_->push_back({t - next.first_t_, next.seen_from_first(pose), reply.F_a});
  ++next.size_;
  return next;
}

TaughtPath TeachIn::path() const {
  TaughtPath path{space_, reference_, with_force_, {}};
  if (poses_) path.poses.assign(poses_->begin(), poses_->begin() + static_cast<std::ptrdiff_t>(size_));
  return path;
}

Replay::Replay(const TaughtPath& taught, Interpolation mu, const Pacing& pacing) {
  if (taught.with_force && mu != Interpolation::tcim_pose)
    throw FaultError(FaultCode::bad_trajectory, "recorded forces can be executed with TCIM-POSE only");
  path_ = Trajectory(linear_spline(knots_of(taught)), {taught.space, taught.reference, mu}, pacing);
  if (taught.with_force)
    force_ = Trajectory(linear_spline(force_knots(taught)), {.space = Representation::joints}, pacing);
}

Wrench Replay::force(std::int64_t k) const {
  if (force_.macrosteps() == 0) return {};
  const Coordinates F = force_.set_position(k + 1);
  return Wrench::from(F.head<3>(), F.tail<3>());
}

ArmCommand Replay::command(std::int64_t k, const TaskFrameCommand& rows) const {
  ArmCommand command = path_.command(k);
  command.frame = rows;
  const Wrench F = force(k);
  for (const Axis axis : kAxes)
    if (rows[axis].b == Behaviour::contact) command.frame[axis].force = F[axis];
  return command;
}

}  // namespace mrroc::ecp
