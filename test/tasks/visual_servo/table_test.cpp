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
  for (X x : all_images()) {
    x.i_0 = x.i;
    int hold = 0;
    for (const Selectable& row : kBehaviours) {
      if (!row.f_sigma(x)) continue;
      ++hold;
      EXPECT_FALSE(row.motion.f_tau(x)) << row.motion.name;
    }
    EXPECT_EQ(hold, 1);
  }
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
  x.i = x.c.seen_in + x.c.k.patience - 1;
  EXPECT_FALSE(in_vain(x));
  ++x.i;
  EXPECT_TRUE(in_vain(x));
  x.c.k.patience = 0;
  EXPECT_FALSE(in_vain(x)) << "no patience: it waits for ever";
}

TEST(ServoTable, GivingUpTellsTheCoordinatorWhy) {
  X x = image({});
  x.i = x.c.seen_in + x.c.k.patience;
  const Report r = kGiveUp.f_cT(x);
  EXPECT_EQ(r.fault.code, FaultCode::object_not_seen);
  EXPECT_NE(r.verdict, Verdict::none);
  EXPECT_NEAR(r.fault.value, r.fault.limit, 1e-9);
  EXPECT_EQ(kGiveUp.f_ce(x).instruction, Instruction::keep);
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
  EXPECT_EQ(select(x).f_cT(x).verdict, Verdict::none) << "the task goes on";
  x.c.refused = kMostRefusals;
  EXPECT_EQ(select(x).f_cT(x).fault.code, FaultCode::too_fast);
  x.c.refused = 0;
  x.e.fault.code = FaultCode::over_current;
  EXPECT_EQ(select(x).f_cT(x).fault.code, FaultCode::over_current) << "everything else is told at once";
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

}  // namespace
}  // namespace mrroc::visual_servo
