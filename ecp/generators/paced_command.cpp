#include "ecp/generators/paced_command.hpp"

#include <algorithm>

#include "base/agent_images.hpp"
#include "base/representation.hpp"
#include "base/screw.hpp"
#include "ecp/generators/commands.hpp"

namespace mrroc::ecp {
namespace {

constexpr double kRounding = 1e-9;  // of sums of paces

// Shares of the force at which an axis settles.
constexpr double kContact =
    0.15;  // less than that may be noise and the weight of a tool that is not quite known
constexpr double kSettled = 0.8;  // from here on the axis presses as it is to

bool moves_arm(const EffectorCommand& c) { return has(c.set, Part::arm); }
bool by_velocity(const EffectorCommand& c) { return c.arm.mu == Interpolation::tcim_velocity; }
bool relative(const EffectorCommand& c) { return c.arm.reference == Reference::relative; }

/// @return whether the one command's pose is where the way to the other one's begins
bool continues(const EffectorCommand& before, const EffectorCommand& next) {
  return moves_arm(before) && !by_velocity(before) && !relative(before) && before.arm.mu == next.arm.mu &&
         before.arm.representation == next.arm.representation;
}

/// Position of the arm, in the representation of a command.
PoseNumbers measured(const EffectorReply& reply, Representation space) {
  PoseNumbers numbers{};
  if (space == Representation::motors)
    std::ranges::copy(reply.motors, numbers.begin());
  else if (space == Representation::joints)
    std::ranges::copy(reply.joints, numbers.begin());
  else
    numbers = numbers_from_pose(space, pose_of(reply));
  return numbers;
}

Pose part_of(const Pose& displacement, double share) { return exp_screw(log_screw(displacement), share); }

/// @return numbers of a share of the way from the one to the other
PoseNumbers between(Representation space, const PoseNumbers& from, const PoseNumbers& to, double share) {
  if (per_axis(space)) {
    PoseNumbers numbers{};
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = from[k] + share * (to[k] - from[k]);
    return numbers;
  }
  const auto a = pose_from_numbers(space, from), b = pose_from_numbers(space, to);
  return a && b ? numbers_from_pose(space, *a * part_of(a->inverse() * *b, share)) : to;
}

/// @return numbers of that part of a displacement
PoseNumbers piece(Representation space, const PoseNumbers& displacement, double share) {
  if (per_axis(space)) {
    PoseNumbers numbers = displacement;
    for (double& v : numbers) v *= share;
    return numbers;
  }
  const auto T = pose_from_numbers(space, displacement);
  return T ? numbers_from_pose(space, part_of(*T, share)) : displacement;
}

/// @return numbers of two displacements, one after the other
PoseNumbers joined(Representation space, const PoseNumbers& first, const PoseNumbers& second) {
  if (per_axis(space)) {
    PoseNumbers numbers = first;
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] += second[k];
    return numbers;
  }
  const auto a = pose_from_numbers(space, first), b = pose_from_numbers(space, second);
  return a && b ? numbers_from_pose(space, *a * *b) : second;
}

}  // namespace

HeldShares held_shares(const TaskFrameCommand& frame, const Wrench& F_a, const HeldShares& held,
                       double pace) {
  HeldShares now;
  for (const Axis a : kAxes) {
    const AxisCommand& row = frame[a];
    if (row.b != Behaviour::guarded || row.velocity == 0) continue;
    const double share = F_a[a] * row.mobility / row.velocity;
    if (share < kContact) continue;
    now[a] = pace == 0 ? held[a] : share >= kSettled ? 1 : share;
  }
  return now;
}

TaskFrameCommand at_pace(TaskFrameCommand frame, double pace, const HeldShares& held) {
  for (const Axis a : kAxes) frame[a].velocity *= pace + (1 - pace) * held[a];
  return frame;
}

bool PacedCommand::ends_within(double pace) const { return done_ + pace > 1 + kRounding; }

void PacedCommand::begin(const EffectorCommand& command) {
  before_ = now_;
  left_ = 1 - done_;
  if (left_ < kRounding) left_ = 0;
  now_ = command;
  done_ = 0;
  sent_ = started_ = false;
}

EffectorCommand PacedCommand::part(double pace, const EffectorReply& reply) {
  const bool first = !sent_;
  const double from = done_;
  if (first && left_ > pace + kRounding) left_ = 0;  // this one does not wait for the one before
  done_ = std::min(1.0, done_ + std::max(0.0, pace - (first ? left_ : 0)));
  sent_ = true;
  if (moves_arm(now_) && by_velocity(now_)) held_ = held_shares(now_.arm.frame, reply.F_a, held_, pace);
  whole_ = first && pace == 1 && left_ == 0;
  if (whole_) return now_;
  if (!moves_arm(now_)) return first ? now_ : rest();
  if (reply.state == DriverState::faulted) return rest();
  if (relative(now_) && !by_velocity(now_)) return displaced(done_ - from, first);
  if (!by_velocity(now_)) return to_pose(done_, reply);
  EffectorCommand command = now_;
  command.arm.frame = at_pace(now_.arm.frame, pace, held_);
  return command;
}

EffectorCommand PacedCommand::to_pose(double share, const EffectorReply& reply) {
  const Representation space = now_.arm.representation;
  if (!started_) start_ = continues(before_, now_) ? before_.arm.pose : measured(reply, space);
  started_ = true;
  EffectorCommand command = now_;
  command.arm.pose = between(space, start_, now_.arm.pose, share);
  return command;
}

EffectorCommand PacedCommand::displaced(double share, bool first) const {
  const Representation space = now_.arm.representation;
  EffectorCommand command = now_;
  command.arm.pose = piece(space, now_.arm.pose, share);
  const bool rest_of_before = first && left_ > 0 && moves_arm(before_) && !by_velocity(before_) &&
                              relative(before_) && before_.arm.representation == space;
  if (rest_of_before)
    command.arm.pose = joined(space, piece(space, before_.arm.pose, left_), command.arm.pose);
  return command;
}

}  // namespace mrroc::ecp
