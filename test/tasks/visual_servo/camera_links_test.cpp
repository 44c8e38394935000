#include "tasks/visual_servo/camera_links.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/fault.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::visual_servo {
namespace {

std::vector<step_sample_t> samples(std::int64_t first, int n) {
  std::vector<step_sample_t> poses(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) poses[static_cast<std::size_t>(k)].T_0E[0] = static_cast<double>(first + k);
  return poses;
}

TEST(NewestFrame, IsTheLastOneWhoseReadingIsVisible) {
  CameraParameters k;
  k.latency = 15;
  EXPECT_EQ(newest_frame(k, 0), -1);
  EXPECT_EQ(newest_frame(k, 14), -1);
  EXPECT_EQ(newest_frame(k, 15), 0);
  EXPECT_EQ(newest_frame(k, 34), 0);
  EXPECT_EQ(newest_frame(k, 35), 1);
  for (std::int64_t step = 15; step < 2000; ++step) {
    const std::int64_t frame = newest_frame(k, step);
    EXPECT_LE(20 * frame + 15, step);
    EXPECT_GT(20 * (frame + 1) + 15, step);
  }
}

TEST(NewestFrame, OfEveryMotionOf21StepsIsNew) {
  const CameraParameters k;
  for (std::int64_t step = 40; step < 5000; step += 21)
    EXPECT_GT(newest_frame(k, step + 21), newest_frame(k, step));
}

TEST(EffectorPath, TellsThePoseOfEveryStepThatItKeeps) {
  EffectorPath path;
  std::int64_t last = 0;
  for (int i = 0; i < 40; ++i) {
    const auto poses = samples(last + 1, 21);
    last += 21;
    path.add(last, poses);
    for (std::int64_t step = std::max<std::int64_t>(1, last + 1 - EffectorPath::kKept); step <= last; ++step)
      EXPECT_EQ(path.at(step).p.x(), static_cast<double>(step));
  }
}

TEST(EffectorPath, TellsTheNearestPoseOfStepsThatItDoesNotKeep) {
  EffectorPath path;
  EXPECT_EQ(path.at(5).p, Vector3(0, 0, 0));
  path.add(120, samples(100, 21));
  EXPECT_EQ(path.at(5).p.x(), 100);
  EXPECT_EQ(path.at(500).p.x(), 120);
}

TEST(EffectorPath, ForgetsWhatWasBeforeAGap) {
  EffectorPath path;
  path.add(120, samples(100, 21));
  path.add(220, samples(200, 21));
  EXPECT_EQ(path.at(150).p.x(), 200);
  EXPECT_EQ(path.at(210).p.x(), 210);
}

TEST(EffectorPath, StaysAsItIsWithoutPoses) {
  EffectorPath path;
  path.add(50, {});
  EXPECT_EQ(path.at(50).p, Vector3(0, 0, 0)) << "there is none yet";
  path.add(120, samples(100, 21));
  path.add(220, {});
  EXPECT_EQ(path.at(150).p.x(), 120);
  EXPECT_EQ(path.at(500).p.x(), 120);
  EXPECT_EQ(path.at(5).p.x(), 100);
}

TEST(EffectorPath, KeepsAsManyStepsAsTheAgentRemembers) {
  EffectorPath path;
  path.add(300, samples(1, 300));
  EXPECT_EQ(path.at(300 - EffectorPath::kKept + 1).p.x(), 300 - EffectorPath::kKept + 1);
  EXPECT_EQ(path.at(300 - EffectorPath::kKept).p.x(), 300 - EffectorPath::kKept + 1);
  EXPECT_EQ(path.at(0).p.x(), 300 - EffectorPath::kKept + 1);
}

TEST(EffectorPath, StepsBeforeTheFirstOneOfARunAreNotKept) {
  EffectorPath path;
  path.add(5, samples(-10, 16));
  EXPECT_EQ(path.at(-3).p.x(), 0);
  EXPECT_EQ(path.at(0).p.x(), 0);
  EXPECT_EQ(path.at(5).p.x(), 5);
}

/// The agent's links, and who speaks on them.
class CameraChannels : public ::testing::Test {
 protected:
  CameraChannels() {
    k.camera[0].latency = 15;
    k.camera[1].latency = 25;
  }
  void begin(ClockKind clock = ClockKind::step) {
    link::NodeContext m{.session = "s", .session_id = 1, .name = "ecp-arm1", .roster = {"mp", "ecp-arm1"}};
    m.clock = clock;
    process.emplace(bus, m);
    links.emplace(*process, CameraLinkNames{"arm1", {"sac.board", "eih.board"}}, k);
    samples_out.emplace(bus, process->route("arm1.samples"), 1);
    sac.emplace(bus, process->route("sac.board"), 1);
    eih.emplace(bus, process->route("eih.board"), 1);
    reports.emplace(bus, process->route("arm1.servo"), 1);
  }
  void tell_samples(std::int64_t stamp, std::int64_t last, int n) {
    step_samples_t m{};
    m.macrostep = stamp;
    m.step = last;
    m.n = n;
    const auto poses = samples(last + 1 - n, n);
    std::ranges::copy(poses, m.sample);
    samples_out->publish(m, stamp);
  }
  static camera_reading_t reading(std::int64_t frame, int seen = 1) {
    camera_reading_t m{};
    m.step = 20 * frame;
    m.seen = seen;
    m.T_CG[0] = m.T_CG[5] = m.T_CG[10] = 1;
    m.T_CG[3] = static_cast<double>(frame);
    return m;
  }

  /// @param frame  that is visible after 40 steps, when four are there  @param x  of E's pose with it
  void expect_reading(ClockKind clock, std::int64_t frame, double x) {
    begin(clock);
    tell_samples(1, 40, 32);
    for (std::int64_t each = 0; each <= 3; ++each) sac->publish(reading(each), each);
    Arm::X seen;
    seen.e.step = 40;
    links->read(seen);
    EXPECT_TRUE(seen.V.camera[0].there);
    EXPECT_FALSE(seen.V.camera[1].there);
    EXPECT_EQ(seen.V.camera[0].reading.frame, frame);
    EXPECT_EQ(seen.V.camera[0].reading.step, 20 * frame);
    EXPECT_EQ(seen.V.camera[0].T_0E.p.x(), x);
  }

  Parameters k;
  link::test::DirectBus bus;
  std::optional<link::Process> process;
  std::optional<CameraLinks> links;
  std::optional<link::Outbox<step_samples_t>> samples_out;
  std::optional<link::Outbox<camera_reading_t>> sac, eih;
  std::optional<link::Queue<servo_report_t>> reports;
};

TEST_F(CameraChannels, ItGoesOnWhenTheStepsAndEveryReadingThatMustBeVisibleAreThere) {
  begin();
  const link::OtherLinks others = links->others();
  EXPECT_EQ(others.sources.size(), 3U);
  EXPECT_FALSE(others.here(1, 14)) << "no steps";
  tell_samples(1, 14, 14);
  EXPECT_TRUE(others.here(1, 14)) << "no picture is visible yet";
  EXPECT_FALSE(others.here(1, 15)) << "the first one of the camera above the scene is";
  sac->publish(reading(0), 0);
  EXPECT_TRUE(others.here(1, 24));
  EXPECT_FALSE(others.here(1, 25)) << "now that of the other one, too";
  eih->publish(reading(0), 0);
  EXPECT_TRUE(others.here(1, 34));
  EXPECT_FALSE(others.here(1, 35)) << "the second one";
  EXPECT_FALSE(others.here(2, 34)) << "the steps of another macrostep";
}

TEST_F(CameraChannels, ACameraThatIsNotUsedIsNotWaitedFor) {
  k.camera[1].used = false;
  begin();
  tell_samples(1, 100, 10);
  sac->publish(reading(4), 4);
  EXPECT_EQ(links->others().sources.size(), 2U);
  EXPECT_TRUE(links->others().here(1, 95));
}

TEST_F(CameraChannels, InLockStepAReadingIsTheOneThatMustBeVisibleWithThePoseOfItsInstant) {
  expect_reading(ClockKind::step, 1, 20);
}

TEST_F(CameraChannels, ByTheWallClockAReadingIsTheNewestWithTheNearestPose) {
  expect_reading(ClockKind::wall, 3, 40);
}

TEST_F(CameraChannels, AReadingThatIsNotFiniteIsMalformed) {
  begin();
  tell_samples(1, 40, 32);
  camera_reading_t bad = reading(1);
  bad.T_CG[3] = std::nan("");
  sac->publish(bad, 1);
  Arm::X x;
  x.e.step = 40;
  try {
    links->read(x);
    ADD_FAILURE() << "it was taken";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::malformed_message);
    EXPECT_EQ(e.fault().text.view(), "camera reading: a number is not finite");
  }
}

TEST_F(CameraChannels, AMacrostepsSamplesMayComeInSeveralMessages) {
  begin();
  const link::OtherLinks others = links->others();
  step_samples_t m{};
  m.macrostep = 1;
  m.more = 1;
  m.step = 5;
  m.n = 5;
  std::ranges::copy(samples(1, 5), m.sample);
  samples_out->publish(m, 1);
  EXPECT_FALSE(others.here(1, 10)) << "there are more";
  m.more = 0;
  m.step = 10;
  std::ranges::copy(samples(6, 5), m.sample);
  samples_out->publish(m, 2);
  EXPECT_TRUE(others.here(1, 10));
}

TEST_F(CameraChannels, MoreOrLessSamplesThanAMessageHasAreCutOff) {
  begin(ClockKind::wall);
  tell_samples(1, 40, 32);
  step_samples_t m{};
  m.macrostep = 2;
  m.step = 90;
  m.n = 1000;
  std::ranges::copy(samples(59, 32), m.sample);
  samples_out->publish(m, 2);
  m.n = -3;
  samples_out->publish(m, 3);
  sac->publish(reading(4), 4);
  Arm::X seen;
  seen.e.step = 100;
  links->read(seen);
  EXPECT_EQ(seen.V.camera[0].T_0E.p.x(), 80);
}

TEST_F(CameraChannels, TheRecordHasWhatWasSeenAndWhatWasDecided) {
  begin();
  tell_samples(1, 40, 32);
  sac->publish(reading(1), 1);
  Arm::X x;
  x.c.k = k;
  x.e.step = 40;
  x.e.T_0E = {1, 2, 3, 0.1, 0.2, 0.3};
  links->read(x);
  Arm::Y y;
  y.c.e.p = {0.01, 0.02, 0.03};
  y.c.under_way.p = {0.04, 0.05, 0.06};
  Motion<Arm> motion{};
  motion.m = 2;
  links->report(motion, x, y, 7);
  x.e.verdict = Verdict::refused;
  x.e.fault.code = FaultCode::too_fast;
  x.V.camera[0].reading.seen = false;
  x.V.camera[1].there = true;
  x.V.camera[1].reading.frame = 9;
  y.c.e.R = rotation_from_angle_axis({0.1, 0.2, 0.3});
  y.c.under_way.R = rotation_from_angle_axis({0.4, 0.5, 0.6});
  y.c.track.known = true;
  y.c.track.v = {1, 2, 3};
  y.c.track.omega = {4, 5, 6};
  y.c.track.P.setIdentity();
  y.c.track.P *= 1e-12;
  links->report(motion, x, y, 8);
  const auto first = reports->take(), second = reports->take();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->header.stamp, 7);
  EXPECT_EQ(second->header.stamp, 8);
  EXPECT_EQ(first->step, 40);
  EXPECT_EQ(first->m, 2);
  EXPECT_EQ(first->refused, 0);
  EXPECT_EQ(second->refused, 1);
  EXPECT_EQ(first->seen[0], 1);
  EXPECT_EQ(second->seen[0], 0);
  EXPECT_EQ(first->seen[1], 0);
  EXPECT_EQ(first->frame[0], 1);
  EXPECT_EQ(first->frame[1], -1) << "it has none";
  EXPECT_EQ(second->frame[1], 9);
  for (int n = 0; n < 6; ++n) EXPECT_EQ(first->T_0E[n], x.e.T_0E[static_cast<std::size_t>(n)]);
  for (int n = 0; n < 3; ++n) {
    EXPECT_EQ(first->e[n], y.c.e.p[n]);
    EXPECT_EQ(first->T_dc[n], y.c.under_way.p[n]);
    EXPECT_EQ(first->e[n + 3], 0);
    EXPECT_EQ(first->v[n], 0);
    EXPECT_NEAR(second->e[n + 3], 0.1 * (n + 1), 1e-12);
    EXPECT_NEAR(second->T_dc[n + 3], 0.1 * (n + 4), 1e-12);
    EXPECT_NEAR(second->v[n], n + 1, 1e-6);
    EXPECT_NEAR(second->v[n + 3], n + 4, 1e-6);
  }
}

}  // namespace
}  // namespace mrroc::visual_servo
