// Strangers on the host: what they send moves nothing, and holds up no emergency stop.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <thread>

#include "base/link/authentication.hpp"
#include "base/link/channel.hpp"
#include "base/link/lcm_packet.hpp"
#include "base/link/session.hpp"
#include "base/operator.hpp"
#include "mrroc/effector_command_t.hpp"
#include "mrroc/hardware_command_t.hpp"
#include "mrroc/operator_order_t.hpp"
#include "mrroc/process_status_t.hpp"
#include "mrroc/supervisor_t.hpp"
#include "test/base/link/flood.hpp"
#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

using namespace std::chrono_literals;
using link::test::Bytes;
using Clock = std::chrono::steady_clock;

template <link::FixedMessage M>
Bytes encoded(const M& m) {
  Bytes bytes(static_cast<std::size_t>(link::encoded_size<M>()));
  m.encode(bytes.data(), 0, link::encoded_size<M>());
  return bytes;
}

/// A datagram of somebody who knows everything but the key: the trailer is random.
Bytes forged(const std::string& channel, Bytes message) {
  static std::mt19937_64 random(1);
  for (std::size_t k = 0; k < link::kTrailer; ++k) message.push_back(static_cast<std::uint8_t>(random()));
  Bytes datagram;
  link::write_packet(datagram, 1, channel, message);
  return datagram;
}

/// @return the only session that the folder's programs run
link::SessionInfo session_in(const Folder& folder) {
  const auto directory = folder / ("mrroc-" + std::to_string(::geteuid()));
  for (const auto end = Clock::now() + 10s; Clock::now() < end; std::this_thread::sleep_for(5ms))
    if (const auto running = link::running_sessions(directory); running.size() == 1) return running[0];
  return {};
}

class Strangers : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "too long";
    if (!multicast()) GTEST_SKIP() << "no multicast";
  }
  Folder folder_{false};
};

TEST_F(Strangers, WhoKnowsTheSessionButNotItsKeyChangesNothing) {
  const auto alone = folder_ / "alone", among = folder_ / "among";
  ASSERT_EQ(run(folder_, "press", {"--processes", "one", "--run-dir", alone.string()}).status, 0);
  Started press(folder_, "press", {"--speed", "4", "--run-dir", among.string()});
  ASSERT_TRUE(press.await_line("m = 1  approach"));
  const link::SessionInfo s = session_in(folder_);
  const link::test::Stranger stranger(*s.address);
  const auto send = [&](const std::string& channel, auto m, std::int64_t number) {
    m.header = {s.id, number, 0};
    stranger.send(forged(s.name + "." + channel, encoded(m)));
    Bytes plain;  // as a sender without keys would
    link::write_packet(plain, 1, s.name + "." + channel, encoded(m));
    stranger.send(plain);
  };
  supervisor_t finished{}, stopping{};
  finished.phase = 3;
  stopping.phase = 2;
  process_status_t faulted{};
  faulted.state = 4;
  faulted.fault.code = 1;
  for (const std::int64_t number :
       {std::int64_t{1}, std::int64_t{1000}, std::numeric_limits<std::int64_t>::max()}) {
    send("supervisor", finished, number);
    send("supervisor", stopping, number);
    send("edp-arm1.status", faulted, number);
    send("arm1.command", effector_command_t{}, number);
    for (std::int32_t order = 0; order < 6; ++order) {
      operator_order_t m{};
      m.id = number;
      m.order = order;
      send("operator", m, number);
    }
  }
  const Ended end = press.end();
  EXPECT_EQ(end.status, 0) << end.all();
  EXPECT_EQ(summary(among)["log_hash"], summary(alone)["log_hash"]);
  std::ifstream messages(among / "messages.log");
  const std::string text{std::istreambuf_iterator<char>(messages), {}};
  EXPECT_NE(text.find(" 60 forged"), std::string::npos) << text;
}

TEST_F(Strangers, AMessageThatIsSentAgainByAStrangerIsObeyedOnce) {
  Started press(folder_, "press", {"--speed", "1", "--attended", "--run-dir", (folder_ / "run").string()});
  const link::SessionInfo s = session_in(folder_);
  link::MulticastSocket ear(s.address->host, s.address->port);
  ASSERT_TRUE(press.await_line("waits for the operator")) << press.end().all();
  for (const auto end = Clock::now() + 60s; run(folder_, "ui_cli", {"start"}).status != 0;)
    ASSERT_LT(Clock::now(), end) << "it waits for its operator";
  ASSERT_TRUE(press.await_line("m = 1  approach"));
  ASSERT_EQ(run(folder_, "ui_cli", {"pause"}).status, 0);
  ASSERT_EQ(run(folder_, "ui_cli", {"resume"}).status, 0);
  const auto all = link::test::heard(ear);
  const link::test::Stranger stranger(*s.address);
  for (int round = 0; round < 3; ++round)
    for (const Bytes& d : all) stranger.send(d);
  const Ended end = press.end();
  EXPECT_EQ(end.status, 0) << end.all();
  std::ifstream script(folder_ / "run" / "operator.script");
  const std::string text{std::istreambuf_iterator<char>(script), {}};
  EXPECT_EQ(text.find("pause"), text.rfind("pause")) << text;
}

/// What somebody may fill the network with, by name.
std::vector<std::pair<std::string, std::vector<Bytes>>> floods(const link::SessionInfo& s,
                                                               const Bytes& overheard) {
  std::mt19937_64 random(7);
  std::vector<Bytes> junk(64, Bytes(100));
  for (Bytes& d : junk)
    for (auto& b : d) b = static_cast<std::uint8_t>(random());
  operator_order_t order{};
  order.header = {s.id, 1, 0};
  order.id = 1;
  const std::string channel = s.name + ".operator";
  Bytes magic = forged(channel, encoded(order)), piece = magic;
  magic[0] = 'X';
  piece[3] = '3';
  return {{"junk", junk},
          {"wrong magic", {magic}},
          {"pieces of larger messages", {piece}},
          {"too large", {forged(channel, Bytes(60000))}},
          {"wrong size", {forged(channel, Bytes(500))}},
          {"wrong tag", {forged(channel, encoded(order))}},
          {"replayed", {overheard}},
          {"another channel", {forged("other.operator", encoded(order))}}};
}

/// @return from the first sending of an emergency stop to the first drive command that brakes, as they are on the network
Clock::duration time_to_brake(link::Bus& bus, const link::SessionInfo& s) {
  link::Queue<hardware_command_t> drive(bus, {link::Group::servo_command, s.name + ".arm1.hardware_command"},
                                        s.id);
  const auto drain = [&](std::chrono::milliseconds time) {
    bus.wait(time);
    bool braked = false;
    while (const auto m = drive.take()) braked = braked || m->enabled == 0;
    return braked;
  };
  for (int k = 0; k < 50; ++k) drain(2ms);
  operator_order_t m{};
  m.header = {s.id, 1, 0};
  m.id = link::random_id();
  m.order = static_cast<std::int32_t>(OperatorOrder::emergency_stop);
  const auto begun = Clock::now();
  for (auto sent = begun - 1s; Clock::now() - begun < 5s;) {
    if (Clock::now() - sent > 20ms) {
      sent = Clock::now();
      bus.publish({link::Group::agents, s.name + ".operator"}, encoded(m));
    }
    if (drain(1ms)) return Clock::now() - begun;
  }
  return Clock::duration::max();
}

TEST_F(Strangers, AnEmergencyStopReachesTheDriverWithinATenthOfASecondInAFloodOfEveryKind) {
  constexpr double kRate = 100000;  // [1/s] of each sender, as far as the host gives it
  // Of both [1/s]. A run has some 1,000 datagrams a second of its own; fewer than five times as many would be no flood. Two
  // cores gave 25,000 and more of every kind, and 74,000 with twelve other processes that wanted them.
  constexpr double kLeast = 5000;
  for (std::size_t kind = 0; kind < 8; ++kind) {
    const std::string name = "run" + std::to_string(kind);
    Started press(folder_, "press", {"--clock", "wall", "--run-dir", (folder_ / name).string()}, name);
    ASSERT_TRUE(press.await_line("m = 1  approach"));
    const link::SessionInfo s = session_in(folder_);
    link::MulticastSocket ear(s.address->host, s.address->port);
    std::this_thread::sleep_for(150ms);
    const auto what = floods(s, link::test::heard(ear).at(0))[kind];
    const auto bus = link::open_session(s);
    const auto begun = Clock::now();
    const link::test::Flood one(*s.address, what.second, kRate), two(*s.address, what.second, kRate);
    std::this_thread::sleep_for(500ms);
    const auto time = time_to_brake(*bus, s);
    const double rate = static_cast<double>(one.sent() + two.sent()) /
                        std::chrono::duration<double>(Clock::now() - begun).count();
    EXPECT_LE(time, 100ms) << what.first;
    EXPECT_GE(rate, kLeast) << what.first << ": it was no flood";
    std::printf("%-26s %6.0f /s: %.1f ms\n", what.first.c_str(), rate,
                std::chrono::duration<double, std::milli>(time).count());
    EXPECT_EQ(press.end().status, 1) << what.first;
  }
}

}  // namespace
}  // namespace mrroc::test
