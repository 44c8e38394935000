// Command of one macrostep of task time, spread over several macrosteps while task time is slow (rule R8).
#pragma once
#include "base/effector_command.hpp"

namespace mrroc::ecp {

/// Which share of its velocity an axis keeps however slowly task time goes, 0..1 along and about each axis of E.
/// Only GUARDED axes keep any: where one presses, its velocity is what it presses with (v / B), and no motion.
using HeldShares = Wrench;

/// @param held   in the macrostep before  @param F_a  measured now
/// @param pace   of task time; at 0 what is held does not change, but for an axis that has lost its contact
/// @return 1 for an axis that presses with nearly the force at which it settles; F_a B / v for one on its way there, which so
///         holds the force that it has; 0 for one without contact
[[nodiscard]] HeldShares held_shares(const TaskFrameCommand& frame, const Wrench& F_a, const HeldShares& held,
                                     double pace);

/// @return the command with its desired velocities scaled by the pace of task time; forces stay, and shares that are held
[[nodiscard]] TaskFrameCommand at_pace(TaskFrameCommand frame, double pace, const HeldShares& held = {});

/// Executes commands one after another, each for one macrostep of task time. At full pace that is one macrostep, and what is
/// sent is the command as it is. At a lower pace velocities are scaled, and a pose is approached in parts of the way to
/// it: the path is the same whatever the pace. At pace 0 the arm is commanded to stay, with its forces.
class PacedCommand {
 public:
  /// @return whether the command ends in a macrostep of that pace before the macrostep does: the next one is needed
  [[nodiscard]] bool ends_within(double pace) const;
  /// Takes the next command; what is left of the one before comes first.
  void begin(const EffectorCommand& command);
  /// @param pace   of the macrostep
  /// @param reply  x_ce, newest
  /// @return what to send for the macrostep. A command that is no motion of the arm is sent once; afterwards the arm rests
  EffectorCommand part(double pace, const EffectorReply& reply);
  /// @return whether part() has given the whole command last
  [[nodiscard]] bool was_whole() const { return whole_; }

 private:
  [[nodiscard]] EffectorCommand to_pose(double share, const EffectorReply& reply);
  [[nodiscard]] EffectorCommand displaced(double share, bool first) const;

  EffectorCommand before_, now_;
  double left_{};  // of the one before, when this one began
  double done_{1};
  bool sent_{}, whole_{};
  PoseNumbers start_{};  // of the way to a pose
  bool started_{};
  HeldShares held_{};
};

}  // namespace mrroc::ecp
