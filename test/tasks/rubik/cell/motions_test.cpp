// The motions between the postures of the usual cell: what they cost, what is free, and how soon the second arm may follow.
#include "tasks/rubik/plan/motions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"

namespace mrroc::rubik {
namespace {

class MotionsOfTheUsualCell : public testing::Test {
 protected:
  int any(std::size_t count) {
    return std::uniform_int_distribution<>(0, static_cast<int>(count) - 1)(random_);
  }
  ArmTransfer any_of(MotionKind kind, Hand hand) {
    const auto own = motions_.configurations(hand).size() - 1;
    return {kind, hand, any(own), any(own), any(motions_.configurations(other(hand)).size() - 1)};
  }

  CubePlanCell cell_{usual_cell(), viewing_place()};
  Motions motions_{cell_};
  std::mt19937 random_{6};
};

TEST_F(MotionsOfTheUsualCell, ClassesAreOfPosturesThatDifferByWholeTurnsOfTheLastJoint) {
  for (const Hand hand : kHands) {
    std::vector<int> seen;
    for (const std::vector<int>& members : motions_.classes(hand))
      for (const int member : members) {
        seen.push_back(member);
        const ArmConfiguration &one = motions_.configuration(hand, members.front()),
                               &other = motions_.configuration(hand, member);
        EXPECT_EQ(one.place, other.place);
        const double turns = (other.hold - one.hold).tail<1>()[0] / (2 * std::numbers::pi);
        EXPECT_NEAR(turns, std::round(turns), 1e-3);
        EXPECT_TRUE(members.size() == 1 || one.place != Place::shown);
      }
    std::ranges::sort(seen);
    ASSERT_EQ(seen.size(), motions_.configurations(hand).size());
    for (std::size_t k = 0; k < seen.size(); ++k) EXPECT_EQ(seen[k], static_cast<int>(k));
    // No two of them are one.
    const int count = static_cast<int>(motions_.classes(hand).size());
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < a; ++b) {
        const ArmConfiguration &one = motions_.example(hand, a), &two = motions_.example(hand, b);
        const double turns = (two.hold - one.hold).tail<1>()[0] / (2 * std::numbers::pi);
        EXPECT_FALSE(one.place == two.place && one.place != Place::shown &&
                     std::abs(turns - std::round(turns)) < 1e-3);
      }
  }
}

TEST_F(MotionsOfTheUsualCell, AClassIsTurnedByQuartersInFrontAlone) {
  const int count = static_cast<int>(motions_.classes(Hand::track).size());
  for (int k = 0; k < count; ++k)
    for (int quarters = -3; quarters <= 3; ++quarters) {
      const auto to = motions_.turned_class(k, quarters);
      const ArmConfiguration& from = motions_.example(Hand::track, k);
      ASSERT_EQ(to.has_value(), from.place == Place::front);
      if (!to) continue;
      const ArmConfiguration& there = motions_.example(Hand::track, *to);
      EXPECT_EQ(there.place, Place::front);
      const double turns = (there.hold - from.hold).tail<1>()[0] / (2 * std::numbers::pi) - quarters / 4.0;
      EXPECT_NEAR(turns, std::round(turns), 1e-3);
    }
}

// Before and after paths have been looked for, some of which are not there.
TEST_F(MotionsOfTheUsualCell, AMotionBetweenClassesTakesTheLeastTimeOfTheirMembers) {
  constexpr std::array kKinds{MotionKind::carry, MotionKind::reach, MotionKind::turn, MotionKind::retreat};
  int none = 0;
  for (int run = 0; run < 60; ++run) {
    const Hand hand = run % 2 == 0 ? Hand::track : Hand::postument;
    const MotionKind kind = kKinds[static_cast<std::size_t>(run / 2 % 4)];
    const ArmTransfer m{kind, hand, any(motions_.classes(hand).size() - 1),
                        any(motions_.classes(hand).size() - 1),
                        any(motions_.classes(other(hand)).size() - 1)};
    const auto members = [&](bool look) {
      double least = std::numeric_limits<double>::infinity();
      for (const int from : motions_.classes(hand)[static_cast<std::size_t>(m.from)])
        for (const int to : motions_.classes(hand)[static_cast<std::size_t>(m.to)])
          for (const int others : motions_.classes(other(hand))[static_cast<std::size_t>(m.others)]) {
            const ArmTransfer member{kind, hand, from, to, others};
            if (look && any(3) == 0) {
              const FreeMotion* const found = motions_.find(member);
              none += found == nullptr;
              EXPECT_EQ(motions_.seconds(member),
                        found ? found->seconds : std::numeric_limits<double>::infinity());
            }
            least = std::min(least, motions_.seconds(member));
          }
      return least;
    };
    EXPECT_EQ(motions_.class_seconds(m), members(false));
    members(true);
    EXPECT_EQ(motions_.class_seconds(m), members(false));
  }
  EXPECT_GT(none, 20);
}

TEST_F(MotionsOfTheUsualCell, AStraightMotionTakesTheTimeOfItsLineWhateverIsFound) {
  for (int run = 0; run < 20; ++run) {
    const ArmTransfer m = any_of(MotionKind::carry, run % 2 == 0 ? Hand::track : Hand::postument);
    const auto& classes = motions_.classes(m.hand);
    const int from = any(classes.size() - 1), to = any(classes.size() - 1);
    double least = std::numeric_limits<double>::infinity();
    for (const int a : classes[static_cast<std::size_t>(from)])
      for (const int b : classes[static_cast<std::size_t>(to)])
        least = std::min(least, seconds_along(cell_, m.hand,
                                              {motions_.configuration(m.hand, a).hold,
                                               motions_.configuration(m.hand, b).hold}));
    (void)motions_.find(m);
    EXPECT_EQ(motions_.straight_seconds(MotionKind::carry, m.hand, from, to), least);
  }
}

TEST_F(MotionsOfTheUsualCell, WhatIsKnownOfTheOldStartIsForgottenWithIt) {
  const Hand hand = Hand::track;
  const int start = motions_.start(hand);
  const ArmTransfer from_start{MotionKind::carry, hand, start, 0, 0};
  const ArmTransfer elsewhere{MotionKind::carry, hand, 1, 0, 0};
  (void)motions_.find(from_start);
  (void)motions_.find(elsewhere);
  const double kept = motions_.seconds(elsewhere);
  ArmJoints joints = cell_.meeting().joints;
  joints[index(hand)] = motions_.configuration(hand, 2).back();
  motions_.start_at(joints);
  EXPECT_EQ(motions_.start(hand), start);
  EXPECT_EQ(motions_.configuration(hand, start).hold, joints[index(hand)]);
  EXPECT_EQ(motions_.seconds(from_start),
            seconds_along(cell_, hand, {joints[index(hand)], motions_.configuration(hand, 0).hold}));
  EXPECT_EQ(motions_.seconds(elsewhere), kept);
}

// Asked of one that has known another start, and of one that has not.
TEST_F(MotionsOfTheUsualCell, AfterANewStartEverythingIsAsIfThereHadBeenNoOther) {
  const ArmJoints joints = {motions_.configuration(Hand::postument, 3).back(),
                            motions_.configuration(Hand::track, 2).back()};
  Motions fresh(cell_);
  fresh.start_at(joints);
  for (int round = 0; round < 2; ++round) {
    for (const Hand holder : kHands) {
      const Hand comes = other(holder);
      const int start = motions_.start(holder), others = motions_.start(comes);
      for (const auto& [from, waits] : {std::pair(start, 1), {1, others}, {start, others}}) {
        const ArmTransfer carry{MotionKind::carry, holder, from, 0, waits};
        const ArmTransfer reach{MotionKind::reach, comes, waits, 0, 0};
        for (const ArmTransfer& m : {carry, reach}) {
          const FreeMotion *is = motions_.find(m), *would = fresh.find(m);
          if (round == 0) continue;
          ASSERT_EQ(is == nullptr, would == nullptr);
          if (is && would) {
            EXPECT_EQ(is->seconds, would->seconds);
          }
          EXPECT_EQ(motions_.seconds(m), fresh.seconds(m));
        }
        const auto delay = motions_.delay(carry, reach);
        if (round > 0) {
          EXPECT_EQ(delay, fresh.delay(carry, reach)) << from << ' ' << waits;
        }
      }
    }
    motions_.start_at(joints);
  }
}

// It may set out when it comes 0.2 s after the cube at the earliest; tried are that and quarters of the carrying motion,
// as long as it sets out within four fifths of that.
TEST_F(MotionsOfTheUsualCell, TheSecondArmSetsOutAsSoonAsItComesLateEnoughAndNothingCollides) {
  const Paths paths(cell_);
  int at_once = 0, later = 0, never = 0;
  for (int run = 0; run < 2000 && at_once + later + never < 30; ++run) {
    const Hand holder = run % 2 == 0 ? Hand::track : Hand::postument;
    const ArmTransfer carry = any_of(MotionKind::carry, holder);
    ArmTransfer reach = any_of(MotionKind::reach, other(holder));
    reach.from = carry.others;
    reach.others = carry.to;
    const FreeMotion *first = motions_.find(carry), *second = motions_.find(reach);
    const auto delay = motions_.delay(carry, reach);
    if (!first || !second || first->seconds <= 0) {
      EXPECT_FALSE(delay && (!first || !second));
      continue;
    }
    CellState state;
    state.grasp = {holder, Face::D, Face::B};
    state.jaws[index(holder)] = kEdge;
    state.jaws[index(other(holder))] = kOpenJaws;
    const double least = std::max(0.0, first->seconds + kLag - second->seconds);
    std::optional<double> soonest;
    for (const double share : {0.0, 0.25, 0.5, 0.75}) {
      const double tried = std::max(least, share * first->seconds);
      if (tried >= 0.8 * first->seconds || !paths.are_free(*first, *second, tried, state)) continue;
      soonest = tried;
      break;
    }
    ASSERT_EQ(delay, soonest) << run;
    EXPECT_EQ(motions_.delay(carry, reach), delay) << "the same again";
    ++(!delay ? never : *delay <= 1e-9 + least ? at_once : later);
  }
  EXPECT_GT(at_once, 5);
  EXPECT_GT(later, 1);
  EXPECT_GT(never, 2);
}

/// A cell that writes down the states that it is asked for.
class Written final : public PlanCell {
 public:
  explicit Written(const PlanCell& cell) : cell_(cell) {}
  [[nodiscard]] const Meeting& meeting() const override { return cell_.meeting(); }
  [[nodiscard]] const Viewing* viewing() const override { return cell_.viewing(); }
  [[nodiscard]] const SpeedLimits& limits(Hand hand) const override { return cell_.limits(hand); }
  [[nodiscard]] AxisVector motors(Hand hand, const AxisVector& q) const override {
    return cell_.motors(hand, q);
  }
  [[nodiscard]] AxisVector joints(Hand hand, const AxisVector& m) const override {
    return cell_.joints(hand, m);
  }
  [[nodiscard]] Pose forward(Hand hand, const AxisVector& q) const override { return cell_.forward(hand, q); }
  [[nodiscard]] std::optional<AxisVector> inverse(Hand hand, const Pose& T_UE,
                                                  const AxisVector& near) const override {
    return cell_.inverse(hand, T_UE, near);
  }
  [[nodiscard]] double joint_limit_margin(Hand hand, const AxisVector& q) const override {
    return cell_.joint_limit_margin(hand, q);
  }
  [[nodiscard]] double manipulability(Hand hand, const AxisVector& q) const override {
    return cell_.manipulability(hand, q);
  }
  [[nodiscard]] bool is_free(const CellState& state) const override {
    states.push_back(state);
    return cell_.is_free(state);
  }
  mutable std::vector<CellState> states;

 private:
  const PlanCell& cell_;
};

TEST_F(MotionsOfTheUsualCell, AHandMayTouchTheCubeBetweenItsGripAndWhereItsApproachEndsAlone) {
  const Written cell(cell_);
  Motions motions(cell);
  int found = 0, farther = 0;
  for (int run = 0; run < 400 && found < 12; ++run) {
    const Hand hand = run % 2 == 0 ? Hand::track : Hand::postument;
    const MotionKind kind = found % 2 == 0 ? MotionKind::retreat : MotionKind::reach;
    const ArmTransfer m = any_of(kind, hand);
    const ArmConfiguration& at = motions.configuration(hand, kind == MotionKind::retreat ? m.from : m.to);
    cell.states.clear();
    if (at.path.size() < 2 || !motions.find(m)) continue;
    ++found;
    const auto motor = [&](const AxisVector& q) { return cell.motors(hand, q); };
    const AxisVector grip = motor(at.hold), way = motor(at.path.back()) - grip;
    for (const CellState& s : cell.states) {
      const AxisVector off = motor(s.joints[index(hand)]) - grip;
      const double share = off.dot(way) / way.squaredNorm();
      if (std::abs(share - 1) < 1e-6) continue;  // where both pieces meet
      const bool near = share < 1 && (off - share * way).norm() < 1e-6 * way.norm();
      EXPECT_EQ(s.touched, near) << "share " << share << " of the last piece";
      farther += !near;
    }
  }
  EXPECT_GE(found, 12);
  EXPECT_GT(farther, 100);
}

TEST_F(MotionsOfTheUsualCell, TheOtherHandSeesTheCubeWhereItIs) {
  for (int run = 0; run < 60; ++run) {
    const Hand holder = run % 2 == 0 ? Hand::track : Hand::postument, comes = other(holder);
    const int holds = any(motions_.classes(holder).size() - 1),
              grips = any(motions_.classes(comes).size() - 1);
    const ArmConfiguration &at = motions_.example(holder, holds), &by = motions_.example(comes, grips);
    const bool fits = (at.place == Place::front && by.place == Place::front) ||
                      (at.place == Place::offered && by.place == Place::side);
    if (!fits) continue;
    const Grasp grasp{holder, Face::R, Face::F};
    const Grasp seen = motions_.seen_from(comes, grips, grasp, holds);
    EXPECT_EQ(seen.hand, comes);
    const Matrix3 cube = cell_.forward(holder, at.hold).R * cube_in_hand(grasp).R;
    const Matrix3 same = cell_.forward(comes, by.hold).R * cube_in_hand(seen).R;
    EXPECT_LT((cube - same).norm(), 1e-6) << run;
  }
}

}  // namespace
}  // namespace mrroc::rubik
