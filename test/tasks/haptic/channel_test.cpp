#include "tasks/haptic/channel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mrroc::haptic {
namespace {

constexpr double kMacrostep = 0.004;

/// Sends a packet in every macrostep. @return stamp of what is known in each
std::vector<std::int64_t> known(const ChannelParameters& k, std::uint64_t direction, int macrosteps) {
  Channel channel(k, kMacrostep, direction);
  std::vector<std::int64_t> stamps;
  for (int i = 0; i < macrosteps; ++i) {
    channel.send({.stamp = i, .value = i * Vector3::UnitX(), .energy = 1.0 * i});
    stamps.push_back(channel.receive(i).stamp);
  }
  return stamps;
}

TEST(HapticChannel, DeliversAtOnceWithoutDelayAndLaterByTheDelay) {
  for (const double delay : {0.0, 0.004, 0.1, 0.2}) {
    const auto stamps = known({.delay = delay}, 0, 200);
    const auto late = static_cast<std::int64_t>(std::lround(delay / kMacrostep));
    for (std::int64_t i = 0; i < 200; ++i)
      EXPECT_EQ(stamps[static_cast<std::size_t>(i)], i >= late ? i - late : -1) << delay;
  }
}

TEST(HapticChannel, KeepsTheNewestAndNeverGoesBackHoweverPacketsOvertakeOneAnother) {
  const auto stamps = known({.delay = 0.02, .jitter = 0.05, .loss = 0.3, .seed = 5}, 0, 5000);
  EXPECT_TRUE(std::ranges::is_sorted(stamps));
  for (std::size_t i = 0; i < stamps.size(); ++i)
    EXPECT_LE(stamps[i], std::max<std::int64_t>(-1, static_cast<std::int64_t>(i) - 5));
}

TEST(HapticChannel, LosesTheShareThatItIsToldTo) {
  ChannelParameters k{.loss = 0.1, .seed = 3};
  const auto stamps = known(k, 0, 20'000);
  std::int64_t fresh = 0;
  for (std::size_t i = 0; i < stamps.size(); ++i) fresh += stamps[i] == static_cast<std::int64_t>(i);
  EXPECT_NEAR(1 - static_cast<double>(fresh) / 20'000, 0.1, 0.01);
}

TEST(HapticChannel, IsHardlyEverLaterThanItsLateness) {
  for (const ChannelParameters& k :
       {ChannelParameters{}, ChannelParameters{.jitter = 0.02}, ChannelParameters{.delay = 0.1, .loss = 0.1},
        ChannelParameters{.loss = 0.5}, ChannelParameters{.delay = 0.02, .jitter = 0.02, .loss = 0.3}}) {
    const auto stamps = known(k, 0, 50'000);
    const auto latest = std::lround((k.delay + lateness(k, kMacrostep)) / kMacrostep);
    int later = 0, as_late = 0;
    for (std::size_t i = 100; i < stamps.size(); ++i) {
      const std::int64_t age = static_cast<std::int64_t>(i) - stamps[i];
      later += age > latest;
      as_late += age + 3 >= latest;
    }
    EXPECT_LE(later, 50) << "one in a thousand";
    EXPECT_GT(as_late, 0) << "and it says no more than is so";
  }
}

TEST(HapticChannel, IsTheSameWithTheSameSeedAndAnotherWithAnotherSeedOrDirection) {
  const ChannelParameters k{.delay = 0.02, .jitter = 0.03, .loss = 0.1, .seed = 1};
  ChannelParameters other = k;
  other.seed = 2;
  EXPECT_EQ(known(k, 0, 500), known(k, 0, 500));
  EXPECT_NE(known(k, 0, 500), known(other, 0, 500));
  EXPECT_NE(known(k, 0, 500), known(k, 1, 500));
}

TEST(HapticChannel, DoesNotCollectWhatIsOvertaken) {
  Channel channel({.delay = 0.2, .jitter = 0.1, .loss = 0.2}, kMacrostep, 0);
  for (int i = 0; i < 5000; ++i) {
    channel.send({.stamp = i});
    channel.receive(i);
    ASSERT_LE(channel.under_way(), 76U) << "0.3 s of packets";
  }
}

}  // namespace
}  // namespace mrroc::haptic
