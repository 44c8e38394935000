// The coordinator's program: free motions, cycles, and the reaction to one that does not come to its end.
#pragma once
#include <algorithm>
#include <cmath>

#include "tasks/rubik/coordinator.hpp"
#include "tasks/rubik/execution_log.hpp"
#include "tasks/rubik/plan/plan.hpp"
#include "tasks/rubik/turn/tables.hpp"

namespace mrroc::rubik {

/// Executes steps of a plan. @tparam P  a Port of the coordinator
template <class P>
class Program {
 public:
  using X = Coordinator::X;  ///< images of the coordinator

  /// @param x  images, valid when the program begins
  Program(X& x, P& port, ExecutionLog& execution_log) : x_(x), port_(port), execution_log_(execution_log) {}

  /// Waits until both arms are ready and the operator has given start.
  Outcome wait_for_start() { return move(kWaitForStart, x_, port_); }

  /// @return faulted: it could not be done; then failure() tells why, both arms are at rest, and the cube is in the
  ///         hand or hands in which it was. Otherwise as the port says
  Outcome execute(const Step& step) {
    x_.c.failure = FailureReason::none;
    execution_log_.push_back({.comes = step.comes, .leaves = step.leaves, .turn = step.turn, .begun = x_.i});
    Outcome o = go_along(step);
    if (step.shows) x_.c.shown.face = static_cast<int>(*step.shows);
    if (well(o)) o = step.shows ? behaviour(kLook) : cycle(step);
    return end(o);
  }

  /// @return whether the step ended with a face that jams and is in its seat again, so that withdraw() is possible
  [[nodiscard]] bool may_withdraw(const Step& step) const {
    return x_.c.failure == FailureReason::jammed && std::abs(execution_log_.back().tool) < kSeated &&
           !step.withdrawal.points.empty();
  }

  /// Takes back a step whose face jams: the hand that has come lets go and draws back, the other one holds the cube as
  /// before. @return as execute()
  Outcome withdraw(const Step& step) {
    x_.c.failure = FailureReason::none;
    x_.c.cycle.leaves = step.comes;
    x_.c.coordination = {.m = 6};
    execution_log_.back().given_up = true;
    Outcome o = behaviour(kCycle[5]);
    if (well(o)) o = go(step.withdrawal, step.before_grasp.hand, false);
    return end(o);
  }

  /// @return what was wrong with the last step; none: nothing
  [[nodiscard]] FailureReason failure() const { return x_.c.failure; }

 private:
  static constexpr double kSeated = 0.05;  // of a tool, from which its face falls into the seat [rad]

  Outcome end(Outcome o) {
    const FailureReason failure = x_.c.failure;
    if (o == Outcome::terminated && failure != FailureReason::none) {
      o = behaviour(kStopBoth);
      if (o == Outcome::terminated) o = Outcome::faulted;
    }
    x_.c.failure = failure;
    execution_log_.back().ended = x_.i;
    return o;
  }

  [[nodiscard]] bool well(Outcome o) const {
    return o == Outcome::terminated && x_.c.failure == FailureReason::none;
  }

  /// One behaviour, to its end: a pause of the operator waits for the next pause().
  Outcome behaviour(const Motion<Coordinator>& motion) { return move(motion, x_, port_); }
  /// Stands while the operator has a pause. Called before free motions and before a cycle, never within m = 1..6.
  Outcome pause() { return x_.t.paused ? move(kResume, x_, port_) : Outcome::terminated; }

  Outcome go_along(const Step& step) {
    const Hand carrier = step.before_grasp.hand;
    Outcome o = Outcome::terminated;
    if (!sent_at_once(step.before)) {
      for (const FreeMotion& motion : step.before)
        if (well(o)) o = go(motion, carrier, true);
      return o;
    }
    std::array<JointPath, kArms> paths;
    for (const FreeMotion& motion : step.before) {
      std::size_t next = 1;  // the arm is at the first point
      paths[index(motion.hand)] = part_of(motion, next, carrier);
    }
    o = pause();
    if (well(o)) o = send(paths);
    if (well(o)) o = pause();
    std::array<int, kArms> goes_at = only(step.before[0].hand);
    if (const auto& delay = step.before[1].delay) {
      goes_at[index(step.before[1].hand)] = static_cast<int>(std::ceil(*delay / kPacing.macrostep_s()));
      return well(o) ? go(goes_at, carrier, true) : o;
    }
    if (well(o)) o = go(goes_at, carrier, true);
    if (well(o)) o = pause();
    return well(o) ? go(only(step.before[1].hand), carrier, true) : o;
  }

  /// @return whether these are paths of different arms that an arm can remember
  [[nodiscard]] static bool sent_at_once(const std::vector<FreeMotion>& motions) {
    return motions.size() == kArms && motions[0].hand != motions[1].hand &&
           std::ranges::all_of(motions, [](const FreeMotion& motion) {
             return motion.points.size() <= static_cast<std::size_t>(kMostPoints) + 1;
           });
  }
  /// @return when each arm goes: this one at once, the other one not at all
  [[nodiscard]] static std::array<int, kArms> only(Hand hand) {
    std::array<int, kArms> goes_at{-1, -1};
    goes_at[index(hand)] = 0;
    return goes_at;
  }

  /// @param next  number of its first point, then of the one behind its last @return as much as an arm can remember
  [[nodiscard]] JointPath part_of(const FreeMotion& motion, std::size_t& next, Hand carrier) const {
    JointPath path;
    path.jaws = motion.hand == carrier ? 0 : x_.c.k.open;
    for (; next < motion.points.size() && path.count < kMostPoints; ++next)
      path.add(motion.points[next].motors, motion.points[next].speed);
    return path;
  }

  /// @param carrier  hand that has the cube; the jaws of the other one go to where an empty hand has them
  Outcome go(const FreeMotion& motion, Hand carrier, bool jaws_too) {
    Outcome o = pause();
    std::size_t next = 1;  // the arm is at the first point
    while (well(o) && next < motion.points.size())
      o = go(motion.hand, part_of(motion, next, carrier), carrier, jaws_too);
    return o;
  }

  Outcome go(Hand hand, const JointPath& path, Hand carrier, bool jaws_too = true) {
    std::array<JointPath, kArms> paths;
    paths[index(hand)] = path;
    const Outcome o = send(paths);
    return well(o) ? go(only(hand), carrier, jaws_too) : o;
  }

  Outcome send(const std::array<JointPath, kArms>& paths) {
    x_.c.joint_paths = paths;
    return behaviour(kSendPath);
  }
  Outcome go(const std::array<int, kArms>& goes_at, Hand carrier, bool jaws_too) {
    x_.c.goes_at = goes_at;
    x_.c.jaws_too = jaws_too;
    x_.c.loaded = {};
    x_.c.loaded[index(carrier)] = true;
    return behaviour(kMoveAlong);
  }

  Outcome cycle(const Step& step) {
    Outcome o = pause();
    if (well(o)) o = grip(step);
    if (well(o)) o = turn(step);
    execution_log_.back().done = step.turn && well(o);
    if (well(o)) o = behaviour(kCycle[5]);
    // The jaws come nearer to each other again meanwhile, and on the paths that follow.
    if (well(o)) o = go(step.retreat, step.after_grasp.hand, false);
    return o;
  }

  /// m = 1..4, more than once when the worker does not meet the cube or closes on nothing.
  Outcome grip(const Step& step) {
    for (int attempt = 1;; ++attempt) {
      execution_log_.back().grips = attempt;
      Outcome o = weigh(step.before_grasp.hand);
      x_.c.coordination = {};
      x_.c.cycle = {.holds = step.before_grasp.hand,
                    .comes = step.comes,
                    .leaves = step.leaves,
                    .turn = order_of(step)};
      for (std::size_t m = 1; m <= 4 && well(o); ++m) o = behaviour(kCycle[m - 1]);
      execution_log_.back().travelled = x_.c.travelled;
      if (o == Outcome::terminated && x_.c.failure == FailureReason::no_contact) o = feel_cube(step);
      const FailureReason failure = x_.c.failure;
      const bool again = (failure == FailureReason::no_contact || failure == FailureReason::missed) &&
                         attempt < x_.c.k.attempts;
      if (o != Outcome::terminated || failure == FailureReason::none || !again || step.before.empty())
        return o;
      o = draw_back(step);
      if (!well(o)) return o;
    }
  }

  /// The worker has met nothing: has the cube gone, has it slipped, or has the worker not come to it? Jaws stay where
  /// they are when a cube slips out from between them; pressed together, they tell.
  Outcome feel_cube(const Step& step) {
    Outcome o = behaviour(kStopBoth);
    x_.c.failure = FailureReason::none;
    const Hand holder = step.before_grasp.hand;
    if (o == Outcome::terminated) o = go(holder, JointPath{.jaws = kClosest}, holder);
    if (o == Outcome::terminated && x_.T.agent[index(holder)].gripper < x_.c.k.held)
      x_.c.failure = FailureReason::dropped;
    const bool passed_by = x_.c.travelled > kApproachDistance + x_.c.k.slip;
    if (x_.c.failure == FailureReason::none)
      x_.c.failure = passed_by ? FailureReason::elsewhere : FailureReason::no_contact;
    return o;
  }

  /// Breaks off, opens the jaws and goes back to where the approach began.
  Outcome draw_back(const Step& step) {
    Outcome o = behaviour(kStopBoth);
    x_.c.failure = FailureReason::none;
    JointPath path{.jaws = x_.c.k.open};
    if (well(o)) o = go(step.comes, path, step.before_grasp.hand);
    const Waypoint& begin = step.before.back().points.back();
    path.add(begin.motors, begin.speed);
    return well(o) ? go(step.comes, path, step.before_grasp.hand) : o;
  }

  Outcome weigh(Hand carrier) {
    x_.c.loaded = {};
    x_.c.loaded[index(carrier)] = true;
    return behaviour(kWeighBoth);
  }

  [[nodiscard]] TurnOrder order_of(const Step& step) const {
    if (!step.turn) return {.torque = 0, .mobility = x_.c.k.mobility, .angle = -1};
    return {.torque = std::copysign(x_.c.k.torque, step.angle),
            .mobility = x_.c.k.mobility,
            .angle = std::abs(step.angle)};
  }

  /// m = 5. A face that does not turn is turned back, slowly, and tried again.
  Outcome turn(const Step& step) {
    execution_log_.back().turn_begun = x_.i;
    double done = 0;
    for (int attempt = 1;; ++attempt) {
      execution_log_.back().attempts = step.turn ? attempt : 0;
      Outcome o = step.turn ? turn_by(step.angle - done, x_.c.k.mobility) : behaviour(kCycle[4]);
      done += x_.c.angle;
      note_turn(done);
      if (o != Outcome::terminated || x_.c.failure != FailureReason::jammed) return o;
      o = turn_back(done);
      note_turn(done);
      if (!well(o)) return o;
      if (attempt < x_.c.k.attempts) continue;
      x_.c.failure = FailureReason::jammed;
      return o;
    }
  }

  void note_turn(double done) {
    execution_log_.back().turn_ended = x_.i;
    execution_log_.back().tool = done;
  }

  /// @param done  turned so far [rad]; that is changed
  Outcome turn_back(double& done) {
    Outcome o = behaviour(kStopBoth);
    x_.c.failure = FailureReason::none;
    if (o != Outcome::terminated || std::abs(done) <= x_.c.k.progress) return o;
    o = turn_by(-done, kTurn.az.mobility);
    done += x_.c.angle;
    if (x_.c.failure == FailureReason::jammed)
      x_.c.failure = FailureReason::none;  // not back either: on from there
    return well(o) ? behaviour(kStopBoth) : o;
  }

  Outcome turn_by(double angle, double mobility) {
    x_.c.cycle.turn = {
        .torque = std::copysign(x_.c.k.torque, angle), .mobility = mobility, .angle = std::abs(angle)};
    if (x_.c.coordination.m != 5) x_.c.coordination = {.m = 5};
    return behaviour(kCycle[4]);
  }

  X& x_;
  P& port_;
  ExecutionLog& execution_log_;
};

}  // namespace mrroc::rubik
