#include <gtest/gtest.h>

#include "tasks/visual_servo/program.hpp"
#include "tasks/visual_servo/servo.hpp"
#include "test/tasks/visual_servo/synthetic_cell.hpp"

namespace mrroc::visual_servo {
namespace {

using X = Arm::X;

/// What a camera can have told.
enum class Told : std::uint8_t { nothing, not_seen, seen };

struct CameraCase {
  Told told{};
  std::int64_t age{};  // of the picture, in steps
  bool used{true};
};

/// The rule, stated once more: valid, not older than two frames beyond the latency, and the camera is used.
bool counts(const CameraCase& c) { return c.told == Told::seen && c.used && c.age <= 2 * 20 + 20; }

X image(const std::array<CameraCase, kCameras>& cameras) {
  X x;
  x.c = begin(test::parameters(), 100);
  x.i = 110;
  x.c.made_in = 109;
  x.e.step = 5000;
  for (std::size_t n = 0; n < kCameras; ++n) {
    CameraImage& image = x.V.camera[n];
    x.c.k.camera[n].used = cameras[n].used;
    image.there = cameras[n].told != Told::nothing;
    image.reading.seen = cameras[n].told == Told::seen;
    image.reading.step = x.e.step - cameras[n].age;
    image.reading.frame = image.reading.step / 20;
    image.reading.T_CG.p = {0, 0, 1};
  }
  return x;
}

std::vector<X> all_images(std::vector<std::array<CameraCase, kCameras>>* cases = nullptr) {
  std::vector<CameraCase> one;
  for (const Told told : {Told::nothing, Told::not_seen, Told::seen})
    for (const std::int64_t age : {20, 39, 40, 60, 61, 80, 1000})
      for (const bool used : {true, false}) one.push_back({told, age, used});
  std::vector<X> images;
  for (const CameraCase& sac : one)
    for (const CameraCase& eih : one) {
      images.push_back(image({sac, eih}));
      if (cases) cases->push_back({sac, eih});
    }
  return images;
}

TEST(ServoTable, SelectsTheBehaviourByWhatIsVisible) {
  std::vector<std::array<CameraCase, kCameras>> cases;
  const auto images = all_images(&cases);
  std::set<int> selected;
  for (std::size_t n = 0; n < images.size(); ++n) {
    const bool sac = counts(cases[n][0]), eih = counts(cases[n][1]);
    EXPECT_EQ(select(images[n]).m, sac && eih ? 3 : eih ? 2 : sac ? 1 : kIdle) << n;
    selected.insert(select(images[n]).m);
  }
  EXPECT_EQ(selected.size(), 4u);
}

TEST(ServoTable, OneInitialConditionHoldsInEveryImageAndThatBehaviourDoesNotEndAtOnce) {
  for (const bool known : {false, true})
    for (X x : all_images()) {
      x.i_0 = x.i;
      x.c.track.known = known;
      int hold = 0;
      for (const Selectable& row : kBehaviours) {
        if (!row.f_sigma(x)) continue;
        ++hold;
        EXPECT_FALSE(row.motion.f_tau(x)) << row.motion.name;
      }
      EXPECT_EQ(hold, 1);
    }
}

TEST(ServoTable, WhatNoCameraSeesIsWhereItWasForAsLongAsItIsRemembered) {
  X x = image({});
  x.c.track.known = true;
  x.c.track.T_0G.p = {1, 0, 0};
  x.c.track.step = x.e.step - x.c.k.track.memory;
  const Motion<Arm>& row = select(x);
  EXPECT_EQ(row.m, kFromMemory);
  EXPECT_NE(row.f_ce(x).instruction, Instruction::keep);
  const Pose expected = start_of_command(x).T_0E.inverse() * x.c.track.T_0G * x.c.k.T_EGd.inverse();
  EXPECT_LT((row.f_cc(x).e.p - expected.p).norm(), 1e-9);
  --x.c.track.step;
  EXPECT_EQ(select(x).m, kIdle);
  EXPECT_TRUE(row.f_tau(x));
}

TEST(ServoTable, ABehaviourEndsWhenItsInitialConditionHoldsNoMore) {
  for (X x : all_images()) {
    x.i_0 = x.i - 3;
    for (const Selectable& row : kBehaviours)
      EXPECT_EQ(row.motion.f_tau(x), row.motion.m == kIdle || !row.f_sigma(x)) << row.motion.name;
  }
}

TEST(ServoTable, IdleIsASingleStepInWhichNothingIsCommanded) {
  X x = image({});
  const Motion<Arm>& idle = select(x);
  x.i_0 = x.i;
  EXPECT_FALSE(idle.f_tau(x));
  EXPECT_EQ(idle.f_ce(x).instruction, Instruction::keep);
  ++x.i;
  EXPECT_TRUE(idle.f_tau(x));
}

TEST(ServoTable, EveryOtherBehaviourCommandsARelativeMotionOf21Steps) {
  const CameraCase seen{Told::seen, 30};
  for (const auto& cameras : {std::array{seen, CameraCase{}}, {CameraCase{}, seen}, {seen, seen}}) {
    const X x = image(cameras);
    const EffectorCommand e = select(x).f_ce(x);
    EXPECT_TRUE(has(e.set, Part::arm));
    EXPECT_EQ(e.arm.reference, Reference::relative);
    EXPECT_EQ(e.arm.mu, Interpolation::mim);
    EXPECT_EQ(e.arm.n_s, 21);
    EXPECT_EQ(e.arm.n_Q, 20);
    const Pose T_dc = pose_from_numbers(e.arm.representation, e.arm.pose).value();
    EXPECT_EQ(T_dc.p, select(x).f_cc(x).under_way.p) << "what is commanded is what is remembered";
    EXPECT_GT(T_dc.p.norm(), 0);
  }
}

TEST(ServoTable, MemoryRemembersWhatIsUnderWay) {
  X x = image({CameraCase{Told::seen, 30}, {}});
  x.c.under_way.p = {1e-3, 0, 0};
  const Memory c = select(x).f_cc(x);
  EXPECT_EQ(c.before.p, x.c.under_way.p);
  EXPECT_EQ(c.seen_in, x.i);
  EXPECT_TRUE(c.track.known);
  EXPECT_EQ(c.taken[0], x.V.camera[0].reading.frame);
  EXPECT_EQ(c.taken[1], -1);
  const X blind = image({});
  EXPECT_EQ(select(blind).f_cc(blind).under_way.p, Vector3(0, 0, 0));
  EXPECT_EQ(select(blind).f_cc(blind).seen_in, 100);
}

TEST(ServoTable, TheTaskEndsWithItsTimeAndIsGivenUpWhenNothingIsSeenForTooLong) {
  X x = image({});
  x.i = x.c.begun + x.c.k.duration - 1;
  EXPECT_FALSE(done(x));
  EXPECT_TRUE(in_vain(x));
  ++x.i;
  EXPECT_TRUE(done(x));
  for (const Selectable& row : kBehaviours) EXPECT_TRUE(row.motion.f_tau(x));
  x.i = x.c.seen_in + x.c.k.timeout - 1;
  EXPECT_FALSE(in_vain(x));
  ++x.i;
  EXPECT_TRUE(in_vain(x));
  x.c.k.timeout = 0;
  EXPECT_FALSE(in_vain(x)) << "no timeout: it waits for ever";
}

TEST(ServoTable, GivingUpTellsTheCoordinatorWhy) {
  X x = image({CameraCase{Told::not_seen, 60}, CameraCase{Told::seen, 61}});
  x.i = x.c.seen_in + x.c.k.timeout;
  const Report r = kGiveUp.f_cT(x);
  EXPECT_EQ(r.fault.code, FaultCode::object_not_seen);
  EXPECT_NE(r.verdict, Verdict::none);
  EXPECT_NEAR(r.fault.value, r.fault.limit, 1e-9);
  EXPECT_EQ(kGiveUp.f_ce(x).instruction, Instruction::keep);
}

TEST(ServoTable, GivingUpBlamesTheHostWhenTheNewestPictureOfEveryCameraIsTooOld) {
  for (const auto& [sac, eih, late] :
       {std::tuple{CameraCase{Told::seen, 61}, CameraCase{Told::seen, 300}, true},
        {CameraCase{Told::seen, 61}, CameraCase{Told::not_seen, 61}, true},
        {CameraCase{}, CameraCase{Told::seen, 61}, true},
        {CameraCase{}, CameraCase{}, true},
        {CameraCase{Told::seen, 61}, CameraCase{Told::nothing, 0, false}, true},
        {CameraCase{Told::not_seen, 60}, CameraCase{Told::seen, 300}, false},
        {CameraCase{Told::not_seen, 60}, CameraCase{Told::nothing, 0, false}, false}}) {
    X x = image({sac, eih});
    x.c.k.by_wall_clock = true;
    x.i = x.c.seen_in + x.c.k.timeout;
    const Report r = kGiveUp.f_cT(x);
    EXPECT_EQ(r.verdict, Verdict::failed);
    EXPECT_EQ(r.fault.code, late ? FaultCode::host_too_slow : FaultCode::object_not_seen);
    EXPECT_EQ(r.fault.value > r.fault.limit, late) << r.fault.text.view();
  }
}

TEST(ServoTable, TheHostIsToBlameWithTheWallClockAndWhenPicturesWereTooOldForHalfOfTheTimeout) {
  X x = image({CameraCase{Told::seen, 61}, CameraCase{Told::seen, 300}});
  x.c.k.by_wall_clock = true;
  EXPECT_EQ(select(x).f_cc(x).in_time_in, x.c.in_time_in) << "every picture is too old";
  X blind = image({CameraCase{Told::not_seen, 60}, CameraCase{Told::seen, 300}});
  EXPECT_EQ(select(blind).f_cc(blind).in_time_in, blind.i);
  EXPECT_EQ(select(blind).f_cc(blind).seen_in, blind.c.seen_in);
  x.i = x.c.seen_in + x.c.k.timeout;
  EXPECT_EQ(kGiveUp.f_cT(x).fault.code, FaultCode::host_too_slow);
  x.c.in_time_in = x.i - x.c.k.timeout / 2;
  EXPECT_EQ(kGiveUp.f_cT(x).fault.code, FaultCode::host_too_slow) << "for half of it";
  ++x.c.in_time_in;  // only the last pictures came late: before, the object was not there
  EXPECT_EQ(kGiveUp.f_cT(x).fault.code, FaultCode::object_not_seen);
  x.c.in_time_in = x.c.seen_in;
  x.c.k.by_wall_clock = false;
  EXPECT_EQ(kGiveUp.f_cT(x).fault.code, FaultCode::object_not_seen) << "in lock-step nothing is late";
}

TEST(ServoTable, AReadingIsBelievedForAsLongAsItIsKnownWhereTheEffectorWas) {
  X x = image({CameraCase{Told::seen, 220}, {}});
  EXPECT_FALSE(sees(x, Camera::sac));
  const int frames = longest_age(x.c.k);
  x.c.k.max_age = frames;
  EXPECT_TRUE(sees(x, Camera::sac));
  for (const Camera camera : {Camera::sac, Camera::eih}) {
    EXPECT_LE(oldest_believed(x.c.k, camera), kPosesKept - x.c.k.pacing.n_s);
    x.c.k.max_age = frames + 1;
    EXPECT_GT(oldest_believed(x.c.k, camera), kPosesKept - x.c.k.pacing.n_s);
    x.c.k.max_age = frames;
  }
  x.c.k.camera[index(Camera::eih)].period = 1000;
  EXPECT_LT(longest_age(x.c.k), frames);
  x.c.k.camera[index(Camera::eih)].used = false;
  EXPECT_EQ(longest_age(x.c.k), frames) << "a camera that is not used sets no limit";
}

TEST(ServoTable, AddsNoDisplacementWhileTheDriverHasMissedOne) {
  X x = image({CameraCase{Told::seen, 30}, {}});
  x.waiting = 1;
  EXPECT_EQ(select(x).f_ce(x).instruction, Instruction::keep);
  EXPECT_EQ(select(x).f_cc(x).under_way.p, Vector3(0, 0, 0));
}

TEST(ServoTable, GoesOnMoreSlowlyWhenTheDriverRefusesAndTellsWhenItKeepsRefusing) {
  X x = image({CameraCase{Told::seen, 30}, {}});
  const double full = select(x).f_cc(x).under_way.p.norm();
  for (int k = 0; k < 40; ++k) x.c.under_way = select(x).f_cc(x).under_way;  // up to speed
  x.e.verdict = Verdict::refused;
  x.e.fault.code = FaultCode::too_fast;
  const Memory c = select(x).f_cc(x);
  EXPECT_EQ(c.ease, 0.5);
  EXPECT_EQ(c.refused, 1);
  EXPECT_LT(c.under_way.p.norm(), x.c.under_way.p.norm());
  EXPECT_GT(full, 0);
  for (const FaultCode code : {FaultCode::too_fast, FaultCode::excessive_torque, FaultCode::force_limit}) {
    x.e.fault.code = code;
    EXPECT_EQ(transmission_of(select(x), x).verdict, Verdict::none) << "the task goes on";
    EXPECT_FALSE(in_vain(x));
  }
  x.c.refused = kMostRefusals;
  EXPECT_TRUE(in_vain(x));
  EXPECT_TRUE(select(x).f_tau(x));
  EXPECT_EQ(transmission_of(kGiveUp, x).verdict, Verdict::failed);
  EXPECT_EQ(transmission_of(kGiveUp, x).fault.code, FaultCode::force_limit);
  x.c.refused = 0;
  x.e.state = DriverState::faulted;
  x.e.fault.code = FaultCode::over_current;
  EXPECT_NE(transmission_of(select(x), x).verdict, Verdict::none) << "a malfunction is told at once";
  x.e.state = DriverState::executing;
  x.e.verdict = Verdict::executed;
  x.e.parts = static_cast<std::uint8_t>(Part::arm);
  x.e.fault = {};
  x.c.ease = 0.5;
  EXPECT_NEAR(select(x).f_cc(x).ease, 0.6, 1e-12);
}

TEST(ServoTable, EveryFunctionDependsOnTheImageAlone) {
  for (const X& x : all_images()) {
    const X copy = x;
    for (const Selectable& row : kBehaviours) {
      EXPECT_EQ(row.f_sigma(x), row.f_sigma(copy));
      if (!row.f_sigma(x)) continue;
      EXPECT_EQ(row.motion.f_ce(x).arm.pose, row.motion.f_ce(copy).arm.pose);
      EXPECT_EQ(row.motion.f_cc(x).track.P, row.motion.f_cc(copy).track.P);
    }
  }
}

TEST(ServoTable, TheReportNamesTheCamerasThatSeeAndLeavesTheBehavioursNumberToThePort) {
  std::vector<std::array<CameraCase, kCameras>> cases;
  const auto images = all_images(&cases);
  for (std::size_t n = 0; n < images.size(); ++n)
    for (const Selectable& row : kBehaviours) {
      const Report r = row.motion.f_cT(images[n]);
      EXPECT_EQ(r.m, 0);
      EXPECT_EQ(r.sensor, (counts(cases[n][0]) ? 1 : 0) + (counts(cases[n][1]) ? 2 : 0));
    }
}

TEST(ServoTable, GivingUpTellsHowLongNothingWasSeenAndHowLongItMayBe) {
  X x = image({});
  x.c.k.timeout = 50;
  x.c.seen_in = 60;
  const Report r = kGiveUp.f_cT(x);
  EXPECT_EQ(r.verdict, Verdict::failed);
  EXPECT_EQ(r.fault.code, FaultCode::object_not_seen);
  EXPECT_NEAR(r.fault.value, 50 * 0.042, 1e-12);
  EXPECT_NEAR(r.fault.limit, 50 * 0.042, 1e-12);
  EXPECT_EQ(r.fault.text.view(), "seconds");
  EXPECT_TRUE(in_vain(x));
  x.c.seen_in = 61;
  EXPECT_FALSE(in_vain(x));
  x.c.k.duration = 10;
  EXPECT_TRUE(done(x)) << "begun in 100, it is 110";
  x.c.k.duration = 11;
  EXPECT_FALSE(done(x));
}

}  // namespace
}  // namespace mrroc::visual_servo
