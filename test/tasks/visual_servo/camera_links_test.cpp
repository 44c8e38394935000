#include "tasks/visual_servo/camera_links.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace mrroc::visual_servo
