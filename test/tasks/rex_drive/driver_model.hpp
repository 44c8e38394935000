// A model of a platform's effector driver as a_1 sees it, and a port to it: commands are executed a macrostep after they
// were decided, replies read a macrostep after that.
#pragma once
#include <cmath>
#include <functional>
#include <vector>

#include "base/motion.hpp"
#include "edp/platform/fragment_queue.hpp"
#include "tasks/rex_drive/images.hpp"

namespace mrroc::rex_drive {

/// Takes fragments into the driver's queue and lets their time pass. The platform is always exactly where the reference is.
class DriverModel {
 public:
  PlatformReply step(const PlatformCommand& command) {
    reply_.verdict = Verdict::none;
    if (command.instruction == Instruction::set) take(command.fragment);
    if (!queue_.empty()) queue_.advance(command.pace);
    reply_.accepted = queue_.accepted();
    reply_.notified = queue_.notified();
    reply_.executing = queue_.executing();
    reply_.remaining = queue_.remaining();
    reply_.at_rest = queue_.empty();
    reply_.state = queue_.empty() ? DriverState::holding : DriverState::executing;
    reply_.position_known = true;
    reply_.estimate.p = queue_.at(0).p;
    return reply_;
  }

  /// Stands there; before the first step.
  void stand_at(const PlanarPose& p) {
    queue_.hold_at(p);
    reply_.estimate.p = p;
  }

  /// Fragments that were taken, in their order.
  std::vector<Fragment> taken;
  /// Fragments that were refused.
  int refused{};

 private:
  [[nodiscard]] bool fits(const Fragment& f) const {
    const PathPoint& begin = f.knot.front();
    const PathPoint end = queue_.end();
    return f.number == queue_.accepted() + 1 && !queue_.full() && f.notify >= -kMaxFragmentSteps &&
           f.notify < f.steps && std::hypot(begin.p.x - end.p.x, begin.p.y - end.p.y) < 0.02 &&
           std::abs(wrap_angle(begin.p.phi - end.p.phi)) < 0.03 && std::abs(begin.v - end.v) < 0.1 &&
           std::abs(begin.w - end.w) < 0.2;
  }
  void take(const Fragment& f) {
    if (!fits(f)) {
      reply_.verdict = Verdict::refused;
      ++refused;
      return;
    }
    queue_.push(f);
    taken.push_back(f);
  }

  edp::FragmentQueue queue_;
  PlatformReply reply_;
};

/// Port of a_1 to the model. What the others say is asked of a function in every macrostep.
class ModelPort {
 public:
  using X = Locomotion::X;

  /// @param others  fills in T of x for a macrostep; false: the system stops
  explicit ModelPort(std::function<bool(X&)> others) : others_(std::move(others)) {}

  void dispatch(const Motion<Locomotion>& motion, const Locomotion::Y& y) {
    command_ = y.e;
    said = y.T;
    if (behaviours.empty() || behaviours.back() != motion.m) behaviours.push_back(motion.m);
  }
  Outcome wait() {
    visible_ = made_;
    made_ = driver.step(delay ? delay(command_) : command_);
    return stops_ ? Outcome::aborted : Outcome::terminated;
  }
  void read(X& x) {
    ++x.i;
    x.e = visible_;
    stops_ = !others_(x);
  }

  /// The platform stands there at the beginning.
  void stand_at(const PlanarPose& p) {
    driver.stand_at(p);
    made_ = visible_ = driver.step({});
  }

  DriverModel driver;           ///< what is commanded
  std::vector<int> behaviours;  ///< m of a_1, each once in a row
  Said said;                    ///< that a_1 has said last
  /// Changes commands on their way; empty: nothing.
  std::function<PlatformCommand(const PlatformCommand&)> delay;

 private:
  std::function<bool(X&)> others_;
  PlatformCommand command_;
  PlatformReply made_, visible_;
  bool stops_{};
};

}  // namespace mrroc::rex_drive
