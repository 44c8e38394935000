// Guarantees of every transport, in memory and over the network.
#include "base/link/bus.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "base/link/authentication.hpp"
#include "base/link/lcm_bus.hpp"
#include "base/link/memory_bus.hpp"
#include "base/link/session.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::link {
namespace {

using namespace std::chrono_literals;
using test::Bytes;
using test::Collector;

/// Opens the ends of one system.
class Transport : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == "memory") return;
    address_ = address_for("bus-test-" + std::to_string(random_id() % 100000));
    if (!multicast_works(address_)) GTEST_SKIP() << "no multicast on this host";
  }
  std::unique_ptr<Bus> open() { return GetParam() == "memory" ? hub_.open() : open_lcm(address_, key_); }
  /// Waits until so many have come, at most for two seconds.
  static void await(Bus& bus, const Collector& c, std::size_t n) {
    for (int tries = 0; tries < 200 && c.got.size() < n; ++tries) bus.wait(10ms);
  }

 private:
  MemoryHub hub_;
  LcmAddress address_;
  Key key_ = Key::random();
};

TEST_P(Transport, DeliversEveryMessageOfAChannelInOrderToEverybodyWhoListens) {
  const auto sender = open(), one = open(), two = open();
  Collector first, second, same_end;
  const Route route{Group::agents, "s.a"};
  one->subscribe(route, first);
  one->subscribe(route, same_end);
  two->subscribe(route, second);
  for (std::uint8_t k = 0; k < 100; ++k) sender->publish(route, Bytes{k, 1, 2});
  await(*one, first, 100);
  await(*two, second, 100);
  for (const Collector* c : {&first, &second, &same_end}) {
    ASSERT_EQ(c->got.size(), 100U);
    for (std::uint8_t k = 0; k < 100; ++k) EXPECT_EQ(c->got[k].second, (Bytes{k, 1, 2}));
    EXPECT_EQ(c->got[0].first, "s.a");
  }
}

TEST_P(Transport, ChannelsGroupsAndLookAlikesAreKeptApart) {
  const auto sender = open(), receiver = open();
  Collector got;
  receiver->subscribe({Group::agents, "s.a"}, got);
  for (const char* other : {"sxa", "s.ab", "xs.a", "s", ""})
    sender->publish({Group::agents, other}, Bytes{1});
  sender->publish({Group::agents, "s.a"}, Bytes{2});
  await(*receiver, got, 1);
  receiver->wait(20ms);
  ASSERT_EQ(got.got.size(), 1U);
  EXPECT_EQ(got.got[0].second, Bytes{2});
}

TEST_P(Transport, ListeningToAllGetsEverythingOfTheSessionThatAgentsSay) {
  const auto sender = open(), receiver = open();
  Collector all;
  receiver->subscribe_all("s.", all);
  sender->publish({Group::agents, "sx.a"}, Bytes{1});
  sender->publish({Group::servo_state, "s.state"}, Bytes{2});
  sender->publish({Group::servo_command, "s.command"}, Bytes{3});
  sender->publish({Group::agents, "s.a"}, Bytes{4});
  sender->publish({Group::agents, "s.b"}, Bytes{5});
  await(*receiver, all, 2);
  receiver->wait(20ms);
  ASSERT_EQ(all.got.size(), 2U);
  EXPECT_EQ(all.got[0], (std::pair<std::string, Bytes>("s.a", {4})));
  EXPECT_EQ(all.got[1], (std::pair<std::string, Bytes>("s.b", {5})));
}

TEST_P(Transport, WaitEndsByItselfWhenNothingComes) {
  const auto bus = open();
  Collector got;
  bus->subscribe({Group::agents, "s.a"}, got);
  EXPECT_FALSE(bus->wait(1ms));
}

TEST_P(Transport, AnEndCanLeaveWhileOthersTalk) {
  const auto sender = open();
  const Route route{Group::agents, "s.a"};
  for (int k = 0; k < 20; ++k) {
    Collector got;
    const auto receiver = open();
    receiver->subscribe(route, got);
    receiver->subscribe_all("s.", got);
    sender->publish(route, Bytes{1});
  }
  Collector last;
  const auto receiver = open();
  receiver->subscribe(route, last);
  sender->publish(route, Bytes{1});
  await(*receiver, last, 1);
  EXPECT_EQ(last.got.size(), 1U);
}

INSTANTIATE_TEST_SUITE_P(Bus, Transport, ::testing::Values("memory", "lcm"),
                         [](const auto& instance) { return instance.param; });

TEST(MemoryBus, LosesNothingOfManyThreadsThatSpeakAtOnce) {
  constexpr int kSpeakers = 4, kMessages = 20'000;
  struct Count final : Sink {
    void receive(std::string_view, std::span<const std::uint8_t> bytes) noexcept override { sum += bytes[0]; }
    std::int64_t sum{};
  } count;
  MemoryHub hub;
  const auto listener = hub.open();
  listener->subscribe({Group::agents, "s.a"}, count);
  std::vector<std::unique_ptr<Bus>> buses;
  for (int k = 0; k < kSpeakers; ++k) buses.push_back(hub.open());
  {
    std::vector<std::jthread> speakers;
    for (const auto& bus : buses)
      speakers.emplace_back([&bus] {
        const std::array<std::uint8_t, 1> one{1};
        for (int k = 0; k < kMessages; ++k) bus->publish({Group::agents, "s.a"}, one);
      });
    for (int k = 0; k < 100'000 && count.sum < kSpeakers * kMessages; ++k)
      listener->wait(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(count.sum, kSpeakers * kMessages);
}

}  // namespace
}  // namespace mrroc::link
