// Two arms that do what the coordinator orders, by messages alone: for tests of its program.
#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "base/representation.hpp"
#include "tasks/rubik/coordinator.hpp"
#include "tasks/rubik/turn/tables.hpp"

namespace mrroc::rubik {

/// Port of the coordinator. Everything takes some macrosteps; what goes wrong is told by functions.
class TwoArms {
 public:
  using X = Coordinator::X;

  int limit{100'000};                                              ///< macrosteps
  std::function<bool(int turn)> jams = [](int) { return false; };  ///< attempt at m = 5, counted from 1
  std::function<bool(int grip)> misses = [](int) { return false; };
  std::function<bool(int grip)> finds_nothing = [](int) { return false; };
  bool passes_by{};                                  ///< who finds nothing goes on; else it does not move
  bool gone{};                                       ///< the second arm's hand is empty
  bool stays{};                                      ///< a face that jams cannot be turned back either
  double meets_at{0.01};                             ///< way of the worker to the cube [m]
  bool drops{};                                      ///< the holder's jaws close in m = 5
  bool drops_late{};                                 ///< those of the hand that stays close in m = 6
  std::vector<int> behaviours;                       ///< of the coordinator, one after another
  std::array<std::vector<PathPoint>, kArms> points;  ///< that each arm was told
  std::vector<TurnOrder> turns;                      ///< ordered, at the begin of each m = 5
  std::array<std::int64_t, kArms> begun{};           ///< macrostep in which each arm first set out
  std::vector<std::array<double, kArms>>
      weights;  ///< that the arms were told, at the begin of each weighing [N]

  static constexpr int kGoing = 20;  ///< macrosteps that a free motion takes

  void dispatch(const Motion<Coordinator>& motion, const Coordinator::Y& y) {
    if (behaviours.empty() || behaviours.back() != motion.m) {
      behaviours.push_back(motion.m);
      age_ = 0;
      if (motion.m == 1) ++grips_;
      if (motion.m == 5) turns.push_back(y.T[1].cube.turn);
      if (motion.m == 5) begun_ = angle_;
      if (motion.m == kTakePath) taken_ = {};
      if (motion.m == kWeigh) weights.push_back({y.T[0].cube.weight, y.T[1].cube.weight});
    }
    ++age_;
    for (std::size_t arm = 0; arm < kArms; ++arm) obey(arm, y.T[arm]);
  }
  Outcome wait() { return ++i_ < limit ? Outcome::terminated : Outcome::aborted; }
  void read(X& x) {
    x.i = i_;
    x.T.agent = reports_;
    x.T.h.started = true;
  }

 private:
  void obey(std::size_t arm, const ArmOrder& o) {
    ArmReport& r = reports_[arm];
    r.ready = true;
    r.m = o.m;
    r.event = 0;
    r.driver_state = o.m < kWait ? DriverState::executing : DriverState::holding;
    if (r.gripper == 0) r.gripper = 0.0568;
    const bool acts = o.variant == kActs && age_ > 5;
    if (o.m == kTakePath && o.variant == taken_[arm] && o.cube.point.sound()) {
      points[arm].push_back(o.cube.point);
      ++taken_[arm];
    }
    if (o.m == kTakePath) jaws_[arm] = o.cube.jaws;
    if (o.m == kTakePath) r.cube.points = taken_[arm];
    if (o.m == kGo && ++going_[arm] == 1 && begun[arm] == 0) begun[arm] = i_;
    if (o.m != kGo) going_[arm] = 0;
    if (o.m == kGo && going_[arm] > kGoing) {
      r.event = kGo;
      const bool holds = arm == 1 && !gone && jaws_[arm] == kClosest;
      if (jaws_[arm] > 0) r.gripper = holds ? 0.0568 : jaws_[arm];
    }
    if (o.m == kWeigh && age_ > 20) r.event = kWeigh;
    if (o.m == kGo) r.T_0E[2] = 0;
    if (o.m == 1 && acts) approach(r);
    if (o.m == 2 && acts) r.event = 2;
    if (o.m == 3 && acts) r.gripper = 0.06, r.event = 3;
    if (o.m == 4 && acts) close(r);
    if (o.m == 5) turn(r, o, acts);
    if (o.m == 6 && !acts && drops_late) r.gripper = 0.054;
    if (o.m == 6 && acts) r.gripper = 0.077, r.event = 6;
  }
  void approach(Report& r) const {
    if (finds_nothing(grips_)) {
      if (passes_by) r.T_0E[2] += 0.0002;
      return;
    }
    r.T_0E[2] = meets_at;
    r.event = 1;
  }
  void close(Report& r) const {
    r.gripper = misses(grips_) ? 0.056 : 0.0568;
    r.event = misses(grips_) ? 0 : 4;
  }
  void turn(Report& r, const ArmOrder& o, bool acts) {
    if (drops) r.gripper = 0.054;
    if (!acts) return;
    const TurnOrder t = o.cube.turn;
    const bool jammed = jams(static_cast<int>(turns.size()));
    const double most = jammed ? 0.4 : 10;
    if (jammed) stands_ = stays && std::abs(angle_ - begun_) >= most;
    if (std::abs(angle_ - begun_) < most && !stands_) angle_ += std::copysign(0.01, t.torque);
    r.T_0E[5] = angle_;
    if (std::copysign(1., t.torque) * (angle_ - begun_) >= t.angle) r.event = 5;
  }

  std::array<ArmReport, kArms> reports_;
  std::array<int, kArms> taken_{}, going_{};
  std::array<double, kArms> jaws_{};
  double angle_{}, begun_{};
  bool stands_{};
  int age_{}, grips_{};
  std::int64_t i_{};
};

}  // namespace mrroc::rubik
