// The latency of a key, computed from a driver's record.
#include "bench/latency_samples.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace mrroc::test {
namespace {

using bench::Latency;
using bench::Step;

constexpr std::int64_t kSteps = 600;

/// An arm that moves at 10 mm/s but for the steps from `from` up to `to`.
std::vector<Step> rests(std::int64_t from, std::int64_t to) {
  std::vector<Step> steps;
  double z = 0;
  for (std::int64_t k = 0; k < kSteps; ++k) {
    const bool rest = k >= from && k < to;
    z += rest ? 0 : 0.01 * bench::kStep;
    steps.push_back({k, rest ? "decelerating" : "executing", {0, 0, z}});
  }
  return steps;
}

bool slower(const Step& before, const Step& now) { return bench::speed(before, now) < 0.0095; }

TEST(LatencySamples, AreMeasuredFromTheKeyToTheFirstStepThatIsAsWanted) {
  const Latency l = bench::latency(rests(125, 200), 99.5, slower);
  EXPECT_EQ(l.kind, Latency::Kind::measured);
  EXPECT_DOUBLE_EQ(l.macrosteps, 2.55);
}

TEST(LatencySamples, AreNoneWhenTheArmIsAsWantedAlready) {
  EXPECT_EQ(bench::latency(rests(99, 200), 100, slower).kind, Latency::Kind::nothing_to_see);
  EXPECT_EQ(bench::latency(rests(90, 110), 100, slower).kind, Latency::Kind::nothing_to_see);
  EXPECT_EQ(bench::latency(rests(100, 200), 100, slower).kind, Latency::Kind::measured);
  EXPECT_EQ(bench::latency({}, 100, slower).kind, Latency::Kind::nothing_to_see);
}

TEST(LatencySamples, AKeyWithoutEffectIsNoLongLatency) {
  EXPECT_EQ(bench::latency(rests(kSteps, kSteps), 100, slower).kind, Latency::Kind::never);
  EXPECT_EQ(bench::latency(rests(100 + 337, 500), 100, slower).kind, Latency::Kind::never);
}

TEST(LatencySamples, TellWhetherAPauseWasFollowedByMotion) {
  EXPECT_TRUE(bench::is_undone(rests(100, 150), 140, 170, slower));
  EXPECT_FALSE(bench::is_undone(rests(100, 400), 140, 170, slower)) << "it was the contact, not the pause";
}

TEST(LatencySamples, ReadTheDriversRecord) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("steps-" + std::to_string(::getpid()) + ".csv");
  std::ofstream(file) << "step,time,state,a,set_x,set_y,set_z\n4,0.008,holding,0,1,2,3\n5,0.01,hol";
  const auto steps = bench::read_steps(file);
  std::filesystem::remove(file);
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_EQ(steps[0].k, 4);
  EXPECT_EQ(steps[0].state, "holding");
  EXPECT_EQ(steps[0].set[2], 3);
}

}  // namespace
}  // namespace mrroc::test
