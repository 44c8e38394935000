// What every transport promises, in memory and over the network.
#include "base/link/bus.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "base/link/lcm_bus.hpp"
#include "base/link/memory_bus.hpp"
#include "base/link/session.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::link {
namespace {

using namespace std::chrono_literals;
using test::Bytes;

struct Collector final : Sink {
  std::vector<std::pair<std::string, Bytes>> got;
  void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override {
    got.emplace_back(channel, Bytes(bytes.begin(), bytes.end()));
  }
};

/// Opens the ends of one system.
class Transport : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == "memory") return;
    address_ = address_for("bus-test-" + std::to_string(random_id() % 100000));
    if (!multicast_works(address_)) GTEST_SKIP() << "no multicast on this host";
  }
  std::unique_ptr<Bus> open() { return GetParam() == "memory" ? hub_.open() : open_lcm(address_); }
  /// Waits until so many have come, at most for two seconds.
  static void await(Bus& bus, const Collector& c, std::size_t n) {
    for (int tries = 0; tries < 200 && c.got.size() < n; ++tries) bus.wait(10ms);
  }

 private:
  MemoryHub hub_;
  LcmAddress address_;
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

/// Somebody on this host who sends whatever bytes he likes.
class Stranger {
 public:
  explicit Stranger(const LcmAddress& to) : file_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    to_.sin_family = AF_INET;
    to_.sin_port = htons(static_cast<std::uint16_t>(to.port));
    ::inet_pton(AF_INET, to.host.c_str(), &to_.sin_addr);
    const std::uint8_t ttl = 0;
    ::setsockopt(file_, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  }
  ~Stranger() { ::close(file_); }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;
  void send(const Bytes& datagram) const {
    ::sendto(file_, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&to_), sizeof to_);
  }

 private:
  int file_;
  sockaddr_in to_{};
};

/// @return a piece of a larger message, as LCM makes it
Bytes fragment(std::uint32_t size, std::uint32_t offset, std::uint16_t number, std::uint16_t of,
               std::size_t bytes) {
  Bytes d{'L', 'C', '0', '3', 0, 0, 0, 1};
  for (const std::uint32_t word : {size, offset, static_cast<std::uint32_t>(number) << 16 | of})
    for (int shift = 24; shift >= 0; shift -= 8) d.push_back(static_cast<std::uint8_t>(word >> shift));
  for (const char c : {'s', '.', 'a', '\0'}) d.push_back(static_cast<std::uint8_t>(c));
  d.resize(d.size() + bytes, 1);
  return d;
}

TEST(LcmBus, WhatAStrangerSendsHurtsNobodyAndIsNotHandedOn) {
  const LcmAddress address = address_for("bus-test-" + std::to_string(random_id() % 100000));
  if (!multicast_works(address)) GTEST_SKIP() << "no multicast on this host";
  const auto receiver = open_lcm(address), sender = open_lcm(address);
  Collector got, all;
  const Route route{Group::agents, "s.a"};
  receiver->subscribe(route, got);
  receiver->subscribe_all("s.", all);
  const Stranger stranger(address);
  stranger.send(fragment(1000, 0xFFFFFFCA, 0, 2, 80));  // its offset and size wrap in 32 bits
  stranger.send(fragment(0xFFFFFFFF, 0, 0, 65535, 80));
  stranger.send(fragment(80, 0, 0, 1, 80));
  stranger.send({});
  stranger.send({'L', 'C', '0', '2', 0, 0, 0, 0, 's', '.', 'a'});  // no end of the name
  stranger.send(Bytes(65507, 'L'));
  sender->publish(route, Bytes{5});
  for (int tries = 0; tries < 200 && got.got.empty(); ++tries) receiver->wait(10ms);
  receiver->wait(20ms);
  ASSERT_EQ(got.got.size(), 1U);
  EXPECT_EQ(got.got[0].second, Bytes{5});
  EXPECT_EQ(all.got.size(), 1U);
}

TEST(LcmBus, AFloodHoldsUpNoOtherWork) {
  const LcmAddress address = address_for("bus-test-" + std::to_string(random_id() % 100000));
  if (!multicast_works(address)) GTEST_SKIP() << "no multicast on this host";
  const auto receiver = open_lcm(address);
  Collector got;
  receiver->subscribe({Group::agents, "s.a"}, got);
  std::atomic<bool> ended{false};
  {
    const std::jthread flood([&](const std::stop_token& stop) {
      const Stranger stranger(address);
      const Bytes piece = fragment(256 << 20, 0, 0, 4000, 1400);
      while (!stop.stop_requested()) stranger.send(piece);
      ended = true;
    });
    for (int k = 0; k < 20; ++k) receiver->wait(1ms);  // each returns, though there is always more
    EXPECT_FALSE(ended);
  }
  EXPECT_TRUE(got.got.empty());
}

TEST(LcmAddress, IsReadFromItsOwnUrl) {
  const LcmAddress a{"239.1.2.3", 20004, 1};
  const LcmAddress b = LcmAddress::parse(a.url());
  EXPECT_EQ(b.host, a.host);
  EXPECT_EQ(b.port, a.port);
  EXPECT_EQ(b.ttl, a.ttl);
  EXPECT_EQ(LcmAddress::parse("udpm://239.1.2.3:20004").ttl, 0);
  EXPECT_EQ(a.url(), "udpm://239.1.2.3:20004?ttl=1");  // nothing in it that divides commands in a shell
}

TEST(LcmAddress, EverythingElseIsRefused) {
  for (const char* url :
       {"", "udpm://", "239.1.2.3:7667", "udpm://239.1.2.3", "udpm://239.1.2.3:80", "udpm://239.1.2.3:65534",
        "udpm://239.1.2.3:99999999999999999999", "udpm://239.1.2.3:7667?ttl=", "udpm://239.1.2.3:7667?ttl=-1",
        "udpm://239.1.2.3:7667?ttl=99999999999999999999", "udpm://999.1.2.3:7667", "udpm://10.0.0.1:7667",
        "udpm://239.1.2.3:7667?ttl=256", "tcpq://239.1.2.3:7667", "udpm://239.1.2.3:7667?ttl=0;rm"})
    EXPECT_THROW(LcmAddress::parse(url), std::invalid_argument) << url;
}

}  // namespace
}  // namespace mrroc::link
