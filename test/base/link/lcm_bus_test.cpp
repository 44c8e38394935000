// The transport over the network: what a stranger sends is not handed on, and only the channels that are
// wanted come through.
#include "base/link/lcm_bus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/link/authentication.hpp"
#include "base/link/lcm_packet.hpp"
#include "base/link/session.hpp"
#include "test/base/link/buses.hpp"
#include "test/base/link/stranger.hpp"

namespace mrroc::link {
namespace {

using namespace std::chrono_literals;
using test::Bytes;
using test::Collector;
using test::Stranger;

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
  const Key key = Key::random();
  const auto receiver = open_lcm(address, key), sender = open_lcm(address, key);
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
  EXPECT_EQ(receiver->dropped(), (Dropped{.malformed = 1, .kernel = 5}));
}

TEST(LcmBus, AFloodHoldsUpNoOtherWork) {
  const LcmAddress address = address_for("bus-test-" + std::to_string(random_id() % 100000));
  if (!multicast_works(address)) GTEST_SKIP() << "no multicast on this host";
  const auto receiver = open_lcm(address, Key::random());
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

/// A session in which somebody listens to a channel, and a stranger to its address.
class Overheard : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!multicast_works(address_)) GTEST_SKIP() << "no multicast on this host";
    ear_ = std::make_unique<MulticastSocket>(address_.host, address_.port);
    receiver_ = open_lcm(address_, key_);
    sender_ = open_lcm(address_, key_);
    receiver_->subscribe(channel_, got_);
    stranger_ = std::make_unique<Stranger>(address_);
  }
  /// Hands on what has come. @return the first byte of every message
  std::vector<int> received() {
    while (receiver_->wait(20ms)) {
    }
    std::vector<int> firsts;
    for (const auto& [channel, bytes] : got_.got) firsts.push_back(bytes.at(0));
    return firsts;
  }

  const Route channel_{Group::agents, "s.a"};
  const LcmAddress address_ = address_for("bus-test-" + std::to_string(random_id() % 100000));
  const Key key_ = Key::random();
  std::unique_ptr<MulticastSocket> ear_;
  std::unique_ptr<Bus> receiver_, sender_;
  std::unique_ptr<Stranger> stranger_;
  Collector got_;
};

TEST_F(Overheard, WhatIsSentAgainByAStrangerIsNotHandedOn) {
  for (std::uint8_t k = 1; k <= 3; ++k) sender_->publish(channel_, Bytes{k});
  EXPECT_EQ(received(), (std::vector{1, 2, 3}));
  for (const Bytes& d : test::heard(*ear_)) stranger_->send(d);
  EXPECT_EQ(received(), (std::vector{1, 2, 3}));
  EXPECT_EQ(receiver_->dropped(), (Dropped{.replayed = 3}));
  sender_->publish(channel_, Bytes{4});
  EXPECT_EQ(received(), (std::vector{1, 2, 3, 4})) << "the true sender is heard as before";
}

TEST_F(Overheard, WhoRepeatsAMessageIsHeardAgain) {
  sender_->publish(channel_, Bytes{1});
  sender_->publish(channel_, Bytes{1});
  EXPECT_EQ(received(), (std::vector{1, 1}));
}

TEST_F(Overheard, WhatIsChangedOrMadeUpIsNotHandedOn) {
  sender_->publish(channel_, Bytes{1});
  Bytes d = test::heard(*ear_).at(0);
  EXPECT_EQ(d.size(), kPacketHeader + 4 + 1 + kTrailer);
  d[kPacketHeader + 4] = 9;  // the message
  stranger_->send(d);
  d[kPacketHeader + 4] = 1;
  d[d.size() - kTrailer] ^= 1;  // another sender
  stranger_->send(d);
  Bytes plain;
  write_packet(plain, 1, "s.a", Bytes{8});
  stranger_->send(plain);
  write_packet(plain, 1, "s.a", Bytes(1 + kTrailer, 8));
  stranger_->send(plain);
  const auto other = open_lcm(address_, Key::random());
  other->publish(channel_, Bytes{7});
  EXPECT_EQ(received(), std::vector{1});
  EXPECT_EQ(receiver_->dropped(), (Dropped{.malformed = 1, .forged = 4}));
}

TEST_F(Overheard, ChannelsThatNobodyListensToCostNothing) {
  Bytes d;
  write_packet(d, 1, "s.b", Bytes(1 + kTrailer, 8));
  stranger_->send(d);
  sender_->publish({Group::agents, "s.b"}, Bytes{1});
  EXPECT_TRUE(received().empty());
  EXPECT_EQ(receiver_->dropped(), Dropped{}) << "others' messages are no reproach";
}

TEST_F(Overheard, LcmsToolsSeeAShortPacketWithTheMessageInFront) {
  sender_->publish(channel_, Bytes{1, 2});
  sender_->publish(channel_, Bytes{3});
  const auto all = test::heard(*ear_);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(Bytes(all[1].begin(), all[1].begin() + 13),
            (Bytes{'L', 'C', '0', '2', 0, 0, 0, 2, 's', '.', 'a', 0, 3}));
}

TEST_F(Overheard, WhatIsLargerThanAnyMessageTakesNoRoom) {
  struct Small final : Sink {
    void receive(std::string_view, std::span<const std::uint8_t>) noexcept override { ++count; }
    [[nodiscard]] std::size_t largest() const noexcept override { return 10; }
    int count{};
  } small;
  const auto receiver = open_lcm(address_, key_), hears_all = open_lcm(address_, key_);
  receiver->subscribe(channel_, small);
  hears_all->subscribe_all("s.", small);
  Bytes d;
  write_packet(d, 1, "s.a", Bytes(60000));
  for (int k = 0; k < 300; ++k) stranger_->send(d);  // 18 MB: more than the socket has room for
  sender_->publish(channel_, Bytes(10));
  for (const auto& bus : {receiver.get(), hears_all.get()})
    while (bus->wait(20ms)) {
    }
  EXPECT_EQ(small.count, 2);
  EXPECT_EQ(hears_all->dropped(), (Dropped{.kernel = 300}));
  EXPECT_EQ(receiver->dropped(), Dropped{}) << "the kernel does not tell them from those of other channels";
}

TEST_F(Overheard, WhatIsDroppedDoesNotEndAWait) {
  const std::jthread flood([&](const std::stop_token& stop) {
    Bytes d;
    write_packet(d, 1, "s.a", Bytes(1 + kTrailer, 8));
    while (!stop.stop_requested()) {
      stranger_->send(d);
      std::this_thread::sleep_for(1ms);
    }
  });
  const auto begun = std::chrono::steady_clock::now();
  EXPECT_FALSE(receiver_->wait(50ms));
  EXPECT_GE(std::chrono::steady_clock::now() - begun, 49ms);
}

/// A socket that takes only some channels, and who sends to it on any.
class OnlyWanted : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!multicast_works(address_)) GTEST_SKIP() << "no multicast on this host";
  }
  void send(const std::string& channel) const {
    Bytes d;
    write_packet(d, 1, channel, Bytes(3));
    MulticastSender(address_.host, address_.port, 0).send(d);
  }
  /// @return the channels of all that has come to the socket
  static std::vector<std::string> heard(MulticastSocket& socket) {
    std::vector<std::string> all;
    for (const Bytes& d : test::heard(socket)) all.emplace_back(read_packet(d)->channel);
    return all;
  }
  const LcmAddress address_ = address_for("bus-test-" + std::to_string(random_id() % 100000));
};

TEST_F(OnlyWanted, ChannelsComeThroughTheKernelWhateverTheirNamesHaveInCommon) {
  std::mt19937_64 random(5);
  const auto name = [&random] {  // of two letters, so that many are alike or begin alike
    std::string s(std::uniform_int_distribution<std::size_t>{1, 9}(random), 'a');
    for (char& c : s) c = static_cast<char>('a' + random() % 2);
    return s;
  };
  for (int round = 0; round < 50; ++round) {
    std::vector<std::string> wanted, right;
    for (int k = 0; k < 6; ++k) wanted.push_back(name());
    MulticastSocket socket(address_.host, address_.port);
    socket.take_only(1000, wanted);
    for (int k = 0; k < 40; ++k) {
      const std::string sent = name();
      send(sent);
      if (std::ranges::count(wanted, sent) > 0) right.push_back(sent);
    }
    ASSERT_EQ(heard(socket), right) << "round " << round;
  }
}

TEST_F(OnlyWanted, EveryNewChannelIsHeardHoweverManyThereAre) {
  MulticastSocket socket(address_.host, address_.port);
  std::vector<std::string> channels;
  for (int k = 0; k < 150; ++k) {
    channels.push_back("a-session-of-some-length.channel-" + std::to_string(k));
    socket.take_only(1000, channels);
    for (const std::string& sent : {channels.front(), channels.back()}) send(sent);
    const auto all = heard(socket);
    ASSERT_EQ(all, (std::vector{channels.front(), channels.back()})) << k;
  }
}

TEST_F(OnlyWanted, AllComesThroughWhenTheKernelCannotKnowSoManyChannels) {
  std::vector<std::string> many;
  for (int k = 0; k < 300; ++k) many.push_back(std::string(50, 'x') + std::to_string(k));
  MulticastSocket socket(address_.host, address_.port);
  socket.take_only(1000, many);
  send(many.back());
  send("another");
  EXPECT_EQ(heard(socket), (std::vector<std::string>{many.back(), "another"}));
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
