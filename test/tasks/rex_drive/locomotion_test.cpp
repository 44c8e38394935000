#include "tasks/rex_drive/locomotion.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "tasks/rex_drive/plan/built_in_plans.hpp"
#include "test/tasks/rex_drive/driver_model.hpp"
#include "test/tasks/rex_drive/random_plans.hpp"

namespace mrroc::rex_drive {
namespace {

using X = Locomotion::X;

Plan straight_plan(std::int64_t number) {
  return {.number = number, .n = 2, .point = {{{0.5, 0}, {1, 0}}}, .speed = 0.5};
}

X idle_image() {
  X x;
  x.c = begin({});
  x.e.position_known = true;
  x.e.at_rest = true;
  return x;
}

/// Fragments in c.traj, of half a second each.
X image_with(int fragments) {
  X x = idle_image();
  for (int k = 0; k < fragments; ++k) {
    Trajectory t;
    t.duration = 0.5 + 0.1 * k;
    t.index = k;
    x.c.traj.push_back(t);
  }
  return x;
}

// --- algorithms 4-8, by value ---------------------------------------------------------------------------------

TEST(Algorithm4, ANewPlanReplacesPlanAndFragmentsAndStartsThePlannerAtThePlatform) {
  X x = image_with(2);
  x.e.estimate.p = {0.1, 0.2, 0.3};
  x.T.desired = straight_plan(7);
  const Memory c = take_plan(x);
  EXPECT_TRUE(c.new_plan);
  EXPECT_EQ(c.taken, 7);
  EXPECT_TRUE(c.traj.empty());
  EXPECT_GE(c.plan.size(), 2U);
  EXPECT_EQ(c.trajgen.at.p.x, 0.1);
  EXPECT_EQ(c.trajgen.at.p.phi, 0.3);
  EXPECT_EQ(c.trajgen.at.v, 0);
}

TEST(Algorithm4, APlanThatWasTakenIsNotNew) {
  X x = image_with(2);
  x.c.taken = 7;
  x.T.desired = straight_plan(7);
  const Memory c = take_plan(x);
  EXPECT_FALSE(c.new_plan);
  EXPECT_EQ(c.traj.size(), 2U);
}

TEST(Algorithm4, StartsAtTheEndOfTheLastFragmentWhileThatIsUnderWay) {
  X x = idle_image();
  x.c.handed = 3;
  x.c.end = {{2, 1, 0.5}, 0.6, 0.1};
  x.T.desired = straight_plan(2);
  x.e.remaining = 100;
  EXPECT_EQ(take_plan(x).trajgen.at.v, 0.6);
  x.e.remaining = 5;  // over before a fragment can come
  EXPECT_EQ(take_plan(x).trajgen.at.v, 0);
  EXPECT_EQ(take_plan(x).trajgen.at.p.x, 2);
}

TEST(Algorithm5, ANewPlanTakesAckBack) {
  X x = idle_image();
  x.c.taken = 4;
  x.T.desired = straight_plan(4);
  EXPECT_EQ(take_back_ack(x).event, 4);
  x.T.desired = straight_plan(5);
  EXPECT_EQ(take_back_ack(x).event, 0);
}

TEST(Algorithm6, DropsAFragmentOnlyWhenTheDriverIsReady) {
  X x = image_with(2);
  x.e.notified = 0;
  EXPECT_EQ(plan_and_hand_over(x).traj.size(), 1U);
  EXPECT_EQ(plan_and_hand_over(x).handed, 1);
  x.c.handed = 1;  // handed over, and the driver has not notified yet: the reply is older
  EXPECT_EQ(plan_and_hand_over(x).traj.size(), 2U);
  EXPECT_EQ(plan_and_hand_over(x).handed, 1);
}

TEST(Algorithm6, NewStartsThePlannerOnTheFirstPointAndDropsIt) {
  X x = idle_image();
  x.T.desired = straight_plan(1);
  x.c = take_plan(x);
  const std::size_t points = x.c.plan.size();
  const Memory c = plan_and_hand_over(x);
  EXPECT_FALSE(c.new_plan);
  EXPECT_TRUE(c.trajgen.busy);
  EXPECT_EQ(c.plan.size(), points - 1);
}

TEST(Algorithm6, APlannedFragmentIsAddedWhenPlanningHasTakenItsTime) {
  X x = idle_image();
  x.T.desired = straight_plan(1);
  x.c = take_plan(x);
  x.c = plan_and_hand_over(x);
  x.c.handed = 9;  // the driver wants nothing
  for (int k = 0; k < x.c.k.planner.planning; ++k) {
    EXPECT_TRUE(x.c.traj.empty());
    x.c = plan_and_hand_over(x);
  }
  x.c = plan_and_hand_over(x);
  EXPECT_EQ(x.c.traj.size(), 1U);
  EXPECT_TRUE(x.c.trajgen.busy) << "on the next point";
}

TEST(Algorithm7, HandsTheFirstFragmentOverWithItsStepsAndNotify) {
  X x = image_with(2);
  x.c.traj[0].duration = 2;
  const PlatformCommand y = fragment(x);
  EXPECT_EQ(y.instruction, Instruction::set);
  EXPECT_EQ(y.fragment.number, 1);
  EXPECT_EQ(y.fragment.steps, 100);
  EXPECT_EQ(y.fragment.notify, 46);
  x.c.handed = 1;
  EXPECT_EQ(fragment(x).instruction, Instruction::keep);
}

TEST(Algorithm7, RoutesMapOdometryAndPaceWithEveryCommand) {
  X x = image_with(1);
  x.c.pace = 0.4;
  x.T.map.pose = {50, true, {1, 2, 3}, {}};
  x.V.valid = true;
  x.V.step = 70;
  for (const PlatformCommand& y : {fragment(x), kBehaviours[0].f_ce(x), kBehaviours[2].f_ce(x)}) {
    EXPECT_EQ(y.pace, 0.4);
    EXPECT_EQ(y.map.step, 50);
    EXPECT_EQ(y.odometry.step, 70);
  }
}

TEST(Algorithm8, TellsTheNumberOfThePlan) {
  X x = idle_image();
  x.c.taken = 12;
  EXPECT_EQ(acknowledge(x).event, 12);
  EXPECT_EQ(kBehaviours[1].f_cT(x).event, 0) << "no ack while it is executed";
}

TEST(Report, AFaultThatAnswersNoCommandIsAFailureInEveryBehaviour) {
  X x = idle_image();
  x.e.state = DriverState::decelerating;
  x.e.fault.code = FaultCode::peer_silent;
  for (const auto& behaviour : kBehaviours) {
    const Said said = behaviour.f_cT(x);
    EXPECT_EQ(said.verdict, Verdict::failed) << behaviour.name;
    EXPECT_EQ(said.fault.code, FaultCode::peer_silent) << behaviour.name;
  }
  x.e.verdict = Verdict::refused;
  EXPECT_EQ(kBehaviours[1].f_cT(x).verdict, Verdict::refused);
}

TEST(Report, WithoutAFaultTheVerdictIsThatOfTheDriver) {
  X x = idle_image();
  EXPECT_EQ(kBehaviours[1].f_cT(x).verdict, Verdict::none);
  x.e.verdict = Verdict::executed;
  EXPECT_EQ(kBehaviours[1].f_cT(x).verdict, Verdict::executed);
}

TEST(Pace, FollowsThePauseAndStandsWhileThePositionIsUncertain) {
  X x = idle_image();
  x.T.variant = kPaused;
  EXPECT_EQ(plan_and_hand_over(x).pace, 0) << "at once: the driver is the one that goes to it evenly";
  x.T.variant = 0;
  EXPECT_EQ(plan_and_hand_over(x).pace, 1);
  x.e.estimate.covariance[0] = 0.3 * 0.3;
  EXPECT_EQ(plan_and_hand_over(x).pace, 0);
  EXPECT_NE(kBehaviours[1].f_cT(x).sensor & kPositionLost, 0);
  x.e.estimate.covariance[0] = 1e-4;
  EXPECT_EQ(plan_and_hand_over(x).pace, 1);
}

// --- the loop with a driver -----------------------------------------------------------------------------------

/// Drives plans as a_2 would: the next one `think` macrosteps after the ack. @return the port, to look at
struct Drive {
  std::vector<Plan> plans;
  PlanarPose start;
  std::int64_t think{10};
  int longest{20'000};
  std::vector<std::int64_t> acks{};      // macrosteps
  std::function<void(const X&)> look{};  // in every macrostep

  ModelPort run(std::function<PlatformCommand(const PlatformCommand&)> delay = {}) {
    std::int64_t acked_in = 0;
    std::size_t next = 0;
    ModelPort* self = nullptr;
    ModelPort port([&](X& x) {
      x.T.m = 1;
      if (look) look(x);
      const bool acked = next > 0 && self->said.event == plans[next - 1].number;
      if (acked && acked_in == 0) acks.push_back(acked_in = x.i);
      if (next == 0 || (acked && x.i - acked_in >= think && next < plans.size())) {
        ++next;
        acked_in = 0;
      }
      x.T.desired = plans[next - 1];
      x.T.finished = next == plans.size() && acks.size() == plans.size() && x.e.remaining == 0;
      return --longest > 0;
    });
    self = &port;
    port.stand_at(start);
    port.delay = std::move(delay);
    X x;
    x.c = begin({});
    EXPECT_EQ(run_program(x, port), Outcome::terminated);
    return port;
  }
};

TEST(Locomotion, GoesThroughItsBehavioursAndHandsEveryFragmentOverOnce) {
  const PlanList list = built_in_plan("square");
  Drive drive{to_messages(list, 0.6), list.start};
  const ModelPort port = drive.run();
  EXPECT_EQ(port.driver.refused, 0);
  EXPECT_EQ(port.driver.taken.size(), 7U) << "four legs and three turns";
  EXPECT_EQ(port.behaviours, (std::vector<int>{0, 1, 2, 3, 1}));
}

TEST(Locomotion, PlansThatGoOnAreOneWayWithoutARest) {
  const PlanList list = built_in_plan("figure_eight");
  Drive drive{to_messages(list, 0.6), list.start};
  const ModelPort port = drive.run();
  EXPECT_EQ(port.driver.refused, 0);
  ASSERT_EQ(drive.acks.size(), 2U);
  const auto& taken = port.driver.taken;
  for (std::size_t k = 0; k + 1 < taken.size(); ++k)
    EXPECT_GT(taken[k].knot.back().v, 0.85 * 0.6) << "at the end of fragment " << taken[k].number;
  EXPECT_EQ(taken.back().knot.back().v, 0);
}

/// Straight on in plans of 12 points each, which are 0.2 m apart.
std::vector<Plan> short_legs() {
  PlanList list;
  list.plans.resize(3);
  for (int k = 0; k < 36; ++k) list.plans[static_cast<std::size_t>(k / 12)].push_back({0.2 * (k + 1), 0, 0});
  return to_messages(list, 0.6);
}

TEST(Locomotion, ShortFragmentsAreHandedOverAheadOfTheHorizon) {
  constexpr int kHorizon = 50, kOfEnds = 80;
  Drive drive{short_legs(), {}};
  std::vector<int> remaining;
  drive.look = [&](const X& x) {
    if (x.e.executing > 2 && x.e.accepted < 36) remaining.push_back(x.e.remaining);
  };
  const ModelPort port = drive.run();
  EXPECT_EQ(port.driver.refused, 0);
  ASSERT_EQ(port.driver.taken.size(), 36U);
  ASSERT_GT(remaining.size(), 400U);
  EXPECT_GE(*std::ranges::min_element(remaining), kHorizon - 5) << "the tracker would see an end, and brake";
  EXPECT_LE(*std::ranges::max_element(remaining), kOfEnds) << "no more is handed over than is needed";
}

TEST(Locomotion, ALatePlanBeginsAtRest) {
  const PlanList list = built_in_plan("figure_eight");
  Drive drive{to_messages(list, 0.6), list.start, 400};
  EXPECT_EQ(drive.run().driver.refused, 0);
  EXPECT_EQ(drive.acks.size(), 2U);
}

TEST(Locomotion, APlanOfOnePlaceIsAcknowledgedWithoutAFragment) {
  Drive drive{{{.number = 1, .n = 2, .point = {{{0.01, 0}, {0, 0.01}}}, .speed = 0.5}, straight_plan(2)}, {}};
  const ModelPort port = drive.run();
  EXPECT_EQ(drive.acks.size(), 2U);
  EXPECT_EQ(port.driver.taken.size(), 2U);
}

TEST(Locomotion, APlanThatComesWhileOneIsExecutedWaitsForItsAck) {
  int behaviour_two = 0;
  ModelPort* self = nullptr;
  ModelPort port([&](X& x) {
    x.T.m = 1;
    if (x.T.desired.number == 0) x.T.desired = straight_plan(1);
    if (!self->behaviours.empty() && self->behaviours.back() == 2 && ++behaviour_two == 3)
      x.T.desired = straight_plan(2);
    x.T.finished = self->behaviours.size() >= 8;
    return x.i < 2000;
  });
  self = &port;
  port.behaviours = {0};
  X x;
  x.c = begin({});
  EXPECT_EQ(run_program(x, port), Outcome::terminated);
  ASSERT_GE(port.behaviours.size(), 7U);
  EXPECT_EQ(std::vector<int>(port.behaviours.begin(), port.behaviours.begin() + 7),
            (std::vector<int>{0, 1, 2, 3, 1, 2, 3}));
  EXPECT_EQ(x.c.taken, 2);
}

TEST(Locomotion, RandomPlansAreHandedOverWhateverTheDelayOfCommands) {
  std::mt19937 random(3);
  for (int n = 0; n < 60 && !HasFailure(); ++n) {
    SCOPED_TRACE(n);
    std::deque<PlatformCommand> late;  // commands that wait, in their order
    int wait = 0;
    const auto delay = [&](const PlatformCommand& y) {
      if (y.instruction == Instruction::set) {
        late.push_back(y);
        wait = std::uniform_int_distribution<int>(0, 6)(random);
      }
      if (late.empty() || wait-- > 0) {
        PlatformCommand keep = y;
        keep.instruction = Instruction::keep;
        return keep;
      }
      const PlatformCommand first = late.front();
      late.pop_front();
      return first;
    };
    Drive drive{{winding_plan(random, 12, 0.6)}, {}};
    const ModelPort port = drive.run(n % 2 == 0 ? decltype(port.delay){} : delay);
    EXPECT_EQ(port.driver.refused, 0);
    for (std::size_t k = 0; k < port.driver.taken.size(); ++k)
      EXPECT_EQ(port.driver.taken[k].number, static_cast<std::int64_t>(k + 1));
  }
}

}  // namespace
}  // namespace mrroc::rex_drive
