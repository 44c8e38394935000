#include "tasks/rex_drive/locomotion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <random>

#include "base/latency.hpp"
#include "tasks/rex_drive/plan/built_in_plans.hpp"
#include "test/tasks/rex_drive/driver_model.hpp"
#include "test/tasks/rex_drive/images.hpp"
#include "test/tasks/rex_drive/random_plans.hpp"

namespace mrroc::rex_drive {
namespace {

using X = Locomotion::X;

TEST(Algorithm5, ANewPlanTakesAckBack) {
  X x = idle_image();
  x.c.taken = 4;
  x.T.desired = straight_plan(4);
  EXPECT_EQ(take_back_ack(x).event, 4);
  x.T.desired = straight_plan(5);
  EXPECT_EQ(take_back_ack(x).event, 0);
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

TEST(Report, TellsStateAndPlaceOfThePlatformInEveryBehaviour) {
  const X x = telling_image();
  int m = 0;
  for (const auto* behaviour :
       {&kWaitForStart, &kBehaviours[0], &kBehaviours[1], &kBehaviours[2], &kGiveUp}) {
    const Said said = behaviour->f_cT(x);
    EXPECT_EQ(said.m, m);
    EXPECT_EQ(behaviour->m, m++);
    EXPECT_EQ(said.driver_state, DriverState::holding);
    EXPECT_TRUE(said.ready);
    EXPECT_TRUE(said.position_known);
    EXPECT_EQ(said.T_0E, (std::array<double, 6>{1.5, -0.5, 0, 0, 0, 0.25}));
    EXPECT_EQ(said.estimate.p.y, -0.5);
    EXPECT_EQ(said.sensor, kStands);
    EXPECT_EQ(said.event, 0);
  }
}

TEST(Report, AnUnknownPositionIsNoEstimate) {
  X x = telling_image();
  x.e.position_known = false;
  const Said said = kBehaviours[1].f_cT(x);
  EXPECT_FALSE(said.ready);
  EXPECT_FALSE(said.position_known);
  EXPECT_EQ(said.estimate.p.x, 0);
  EXPECT_EQ(said.T_0E[0], 1.5);
}

TEST(Report, GivingUpIsAFailureForWantOfAPath) {
  const Said said = kGiveUp.f_cT(telling_image());
  EXPECT_EQ(said.verdict, Verdict::failed);
  EXPECT_EQ(said.fault.code, FaultCode::path_not_found);
  EXPECT_FALSE(kGiveUp.f_tau(telling_image())) << "for ever";
}

TEST(Report, TheSensorIsASumOfWhatIsSeenAndWhereThePlatformIs) {
  const auto told = [](auto change) {
    X x = telling_image();
    change(x);
    return kBehaviours[0].f_cT(x).sensor;
  };
  EXPECT_EQ(told([](X& x) { x.T.map.pose.valid = true; }), kMapSeen + kStands);
  EXPECT_EQ(told([](X& x) { x.V.valid = true; }), kOdometrySeen + kStands);
  const auto after = [&](std::int64_t steps) {
    return told([steps](X& x) {
      x.V = {.step = 40, .valid = true};
      x.e.step = 40 + steps;
    });
  };
  EXPECT_EQ(after(500), kOdometrySeen + kStands);
  EXPECT_EQ(after(501), kStands) << "it has fallen silent";
  EXPECT_EQ(told([](X& x) {
              x.V = {.step = 40, .valid = true};
              x.e.step = 40 + 900;
              x.c.k.stale = 1000;  // slow cameras
            }),
            kOdometrySeen + kStands);
  EXPECT_EQ(told([](X& x) { x.e.at_rest = false; }), 0);
  EXPECT_EQ(told([](X& x) { x.e.remaining = 1; }), 0);
  EXPECT_EQ(told([](X& x) { x.e.notified = 5; }), 0);
  // 0.2 m from above, from either axis.
  for (const std::size_t k : {0U, 4U}) {
    EXPECT_EQ(told([k](X& x) { x.e.estimate.covariance[k] = 0.199 * 0.199; }), kStands) << k;
    EXPECT_EQ(told([k](X& x) { x.e.estimate.covariance[k] = 0.201 * 0.201; }), kStands + kPositionLost) << k;
  }
  EXPECT_EQ(told([](X& x) { x.e.estimate.covariance[0] = x.e.estimate.covariance[4] = 0.15 * 0.15; }),
            kStands + kPositionLost);
  EXPECT_EQ(told([](X& x) { x.e.estimate.covariance[0] = -1; }), kStands) << "rounding made it negative";
}

/// A reading of no motion from step 40 to step 80, and wheels that turned by so much meanwhile [rad].
X image_that_sees_rest(double turned) {
  X x = telling_image();
  x.V = {.step_before = 40, .step = 80, .valid = true};
  x.V.A = {1, 0, 0, 1e-4, 0, 1, 0, 0, 0, 0, 1, 0};
  x.e.step = 100;
  for (std::int64_t step = 30; step <= 100; step += 10) {
    const double share = std::clamp((static_cast<double>(step) - 40) / 40, 0.0, 1.0);
    x.c.wheels = watched(x.c.wheels, wheels_at(step, {share * turned, -share * turned, share * turned, 0}));
  }
  return x;
}

TEST(Odometry, OfPicturesThatStandAgainstTheWheelsIsNotPassedOnAndToldOf) {
  for (const auto& behaviour : kBehaviours) {
    const X hanging = image_that_sees_rest(0.1), standing = image_that_sees_rest(0.01);
    EXPECT_FALSE(behaviour.f_ce(hanging).odometry.valid) << behaviour.name;
    EXPECT_EQ(behaviour.f_cT(hanging).sensor, kStands + kPicturesStand) << behaviour.name;
    EXPECT_TRUE(behaviour.f_ce(standing).odometry.valid) << behaviour.name;
    EXPECT_EQ(behaviour.f_cT(standing).sensor, kStands + kOdometrySeen) << behaviour.name;
  }
}

TEST(Odometry, EveryBehaviourRemembersHowTheWheelsTurned) {
  for (const auto& behaviour : kBehaviours) {
    X x = telling_image();
    x.e.estimate.step = 70;
    x.e.estimate.theta = {1, 2, 3, 4};
    const Memory c = behaviour.f_cc(x);
    ASSERT_EQ(c.wheels.size(), 1U) << behaviour.name;
    EXPECT_EQ(c.wheels.back().step, 70);
    EXPECT_EQ(c.wheels.back().theta, x.e.estimate.theta);
  }
}

// Fragments 4 and 5 were handed over before the plan; 6 leads to the plan's second point, 7 and 8 to its fourth.

TEST(Report, ThePointUnderWayIsThatOfTheFragmentThatIsExecuted) {
  X x = telling_image();
  x.c.before_plan = 5;
  x.c.points = {1, 3, 3};
  const int expected[]{0, 0, 2, 4, 4, 0, 0};
  for (int k = 0; k < 7; ++k) {
    x.e.executing = 4 + k;
    EXPECT_EQ(kBehaviours[1].f_cT(x).sensor, kStands + kPointUnit * expected[k]) << x.e.executing;
  }
}

TEST(Behaviours, EndWhenTheirConditionHolds) {
  X x = idle_image();
  EXPECT_FALSE(kWaitForStart.f_tau(x));
  EXPECT_FALSE(kBehaviours[0].f_tau(x));
  EXPECT_TRUE(kBehaviours[1].f_tau(x)) << "nothing is left to hand over";
  EXPECT_FALSE(kBehaviours[2].f_tau(x));
  X started = x;
  started.T.m = 1;
  EXPECT_TRUE(kWaitForStart.f_tau(started));
  X later = x;
  later.i = 1;
  EXPECT_TRUE(kBehaviours[2].f_tau(later));
  X planned = x;
  planned.c.new_plan = true;
  EXPECT_TRUE(kBehaviours[0].f_tau(planned));
  EXPECT_FALSE(kBehaviours[1].f_tau(planned));
  X busy = x;
  busy.c.trajgen.busy = true;
  EXPECT_FALSE(kBehaviours[1].f_tau(busy));
  busy.c.trajgen.failed = true;
  EXPECT_TRUE(kBehaviours[1].f_tau(busy)) << "in vain";
  EXPECT_FALSE(kBehaviours[1].f_tau(image_with(1)));
  X points = x;
  points.c.plan.resize(1);
  EXPECT_FALSE(kBehaviours[1].f_tau(points));
  for (X any : {x, started, planned, busy, points, image_with(1)}) {
    any.T.finished = true;
    EXPECT_TRUE(kWaitForStart.f_tau(any));
    for (const auto& behaviour : kBehaviours) EXPECT_TRUE(behaviour.f_tau(any)) << behaviour.name;
  }
}

TEST(Behaviours, KeepTheirMemoryAtTheirEntry) {
  X x = telling_image();
  x.c.taken = 3;
  for (const auto* behaviour :
       {&kWaitForStart, &kBehaviours[0], &kBehaviours[1], &kBehaviours[2], &kGiveUp}) {
    EXPECT_EQ(behaviour->f_entry(x).taken, 3);
    EXPECT_EQ(behaviour->f_entry(x).handed, 6);
  }
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

// It waits from 0.2 m on, and goes on below 0.16 m.

TEST(Pace, APositionThatIsHardlyBetterIsStillLost) {
  X x = idle_image();
  const auto goes_on = [&x](double sd) {
    x.e.estimate.covariance[0] = sd * sd;
    const bool told = (kBehaviours[1].f_cT(x).sensor & kPositionLost) == 0;
    x.c = plan_and_hand_over(x);
    EXPECT_EQ(told, x.c.pace == 1) << sd << ": a_2 is told what the platform does";
    return told;
  };
  EXPECT_TRUE(goes_on(0.199));
  EXPECT_FALSE(goes_on(0.201));
  EXPECT_FALSE(goes_on(0.199));
  EXPECT_FALSE(goes_on(0.161));
  EXPECT_TRUE(goes_on(0.159));
  EXPECT_TRUE(goes_on(0.199));
}

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
  EXPECT_GE(*std::ranges::min_element(remaining), kHorizon) << "the tracker would see an end, and brake";
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
