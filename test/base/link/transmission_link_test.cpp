// Typed links between agents: one value per macrostep, seen in its own macrostep, and what injection, lateness, wrong
// numbers and the end of the other agent's program make of that.
#include "base/link/transmission_link.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "base/link/memory_bus.hpp"
#include "base/msg/convert.hpp"

namespace mrroc::link {
namespace {

using Value = SensorSetting;
using Message = sensor_setting_t;

Value told(std::int64_t i) { return {.mode = static_cast<int>(i), .value = {0.5 * static_cast<double>(i)}}; }

/// Two agents, a and b, on one bus, in one thread.
class TransmissionLink : public ::testing::Test {
 protected:
  void begin(ClockKind clock, const Injection& injection = {}) {
    in.reset();  // links end before their processes, and these before their buses
    out.reset();
    a.reset();
    b.reset();
    bus_a = hub.open();
    bus_b = hub.open();
    a.emplace(*bus_a, context_of("a", clock));
    b.emplace(*bus_b, context_of("b", clock));
    in.emplace(*b, link_channel("a", "b", "what"), injection);
    out.emplace(*a, link_channel("a", "b", "what"));
  }
  static NodeContext context_of(const std::string& name, ClockKind clock) {
    NodeContext m;
    m.session = "typed";
    m.name = name;
    m.roster = {"mp", "a", "b"};
    m.clock = clock;
    return m;
  }
  void arrive() {
    while (bus_b->wait(std::chrono::milliseconds(0))) {
    }
  }
  void send(std::int64_t i) {
    out->set(told(i));
    out->send(i);
    arrive();
  }

  void deliver(std::int64_t number, std::int64_t stamp) {
    Message m = to_message(told(0));
    m.header = {1, number, stamp};
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(encoded_size<Message>()));
    m.encode(bytes.data(), 0, encoded_size<Message>());
    bus_a->publish(a->route("a.b.what"), bytes);
    arrive();
  }

  MemoryHub hub;
  std::unique_ptr<Bus> bus_a, bus_b;
  std::optional<Process> a, b;
  std::optional<OutgoingLink<Value>> out;
  std::optional<IncomingLink<Value>> in;
};

TEST_F(TransmissionLink, IsNamedByItsAgentsAndWhatIsSaid) {
  EXPECT_EQ(link_channel("map", "rex", "plan"), "map.rex.plan");
}

TEST_F(TransmissionLink, AValueIsSeenInTheMacrostepThatItIsFor) {
  begin(ClockKind::step);
  EXPECT_EQ(in->image().value, Value{}) << "before the first one";
  for (std::int64_t i = 1; i <= 100; ++i) {
    EXPECT_FALSE(in->here(i));
    send(i);
    send(i + 1000);  // of a sender that is ahead; an inbox keeps 16 stamps
    ASSERT_TRUE(in->here(i));
    in->receive(i);
    EXPECT_EQ(in->image().value, told(i));
    EXPECT_FALSE(in->image().late);
  }
}

TEST_F(TransmissionLink, WhatIsNotSetAnewIsSaidAgain) {
  begin(ClockKind::step);
  out->send(1);
  out->set(told(7));
  out->send(2);
  out->send(3);
  arrive();
  for (const auto& [i, value] : {std::pair(1, Value{}), std::pair(2, told(7)), std::pair(3, told(7))}) {
    in->receive(i);
    EXPECT_EQ(in->image().value, value) << i;
    EXPECT_FALSE(in->image().late);
  }
}

TEST_F(TransmissionLink, WithTheWallClockTheNewestThatIsNotFromTheFutureIsTakenAndIsLate) {
  begin(ClockKind::wall);
  in->receive(1);
  EXPECT_TRUE(in->image().late) << "nothing has come";
  send(2);
  send(5);
  in->receive(3);
  EXPECT_EQ(in->image().value, told(2));
  EXPECT_TRUE(in->image().late);
  in->receive(5);
  EXPECT_EQ(in->image().value, told(5));
  EXPECT_FALSE(in->image().late);
  send(4);  // overtaken
  in->receive(6);
  EXPECT_EQ(in->image().value, told(5)) << "never back to an older one";
  EXPECT_TRUE(in->image().late);
}

// 200 links of random seeds: what is seen is what the fates of the messages say, whatever else has come.
TEST_F(TransmissionLink, InjectedLossAndDelayAreAFunctionOfSeedAndStamp) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Injection injection{.loss = 0.2, .duplication = 0.1, .delay = 0.3, .max_delay = 4, .seed = seed};
    begin(ClockKind::step, injection);
    std::int64_t expected = 0;  // stamp of the value that is seen
    int late = 0;
    for (std::int64_t i = 1; i <= 60; ++i) {
      send(i);
      if (seed % 2 == 0) send(i + 1);
      for (std::int64_t sent = std::max<std::int64_t>(1, i - 10); sent <= i; ++sent) {
        const Injection::Fate fate = injection.fate(sent);
        if (fate.copies > 0 && sent + fate.delay <= i) expected = std::max(expected, sent);
      }
      in->receive(i);
      ASSERT_EQ(in->image().value, expected == 0 ? Value{} : told(expected)) << seed << ", " << i;
      ASSERT_EQ(in->image().late, expected < i);
      late += in->image().late ? 1 : 0;
    }
    EXPECT_GT(late, 5);
    EXPECT_LT(late, 55);
  }
}

TEST_F(TransmissionLink, AnImproperValueIsAFaultThatNamesItsChannelAndIsNotSeen) {
  begin(ClockKind::step);
  send(1);
  in->receive(1);
  Value wrong = told(2);
  wrong.value[3] = std::numeric_limits<double>::quiet_NaN();
  out->set(wrong);
  out->send(2);
  arrive();
  try {
    in->receive(2);
    FAIL() << "it was taken";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::malformed_message);
    EXPECT_NE(std::string(e.what()).find("a.b.what"), std::string::npos) << e.what();
  }
  EXPECT_EQ(in->image().value, told(1));
}

// Nobody waits for an agent whose program is over, but for what it has sent.
TEST_F(TransmissionLink, AfterTheEndNothingIsWaitedForButWhatWasSentBefore) {
  begin(ClockKind::step);
  send(1);
  out->set(told(2));
  out->send(2);
  out->end();
  out->end();
  out->set(told(9));
  out->send(4);
  arrive();
  EXPECT_TRUE(in->here(2));
  EXPECT_TRUE(in->here(3));
  EXPECT_TRUE(in->here(1'000'000));
  in->receive(2);
  EXPECT_FALSE(in->image().late);
  in->receive(4);
  EXPECT_EQ(in->image().value, told(2)) << "the last one stays";
  EXPECT_TRUE(in->image().late);
}

TEST_F(TransmissionLink, TheEndDoesNotStandForAMessageThatIsStillOnItsWay) {
  begin(ClockKind::step);
  deliver(1, 1);
  deliver(3, kEndOfLink);
  EXPECT_FALSE(in->here(2)) << "it was sent, and is being repeated";
  EXPECT_FALSE(in->here(3)) << "the missing message may be for this macrostep";
  deliver(2, 2);
  EXPECT_TRUE(in->here(2));
  EXPECT_TRUE(in->here(3));
}

TEST_F(TransmissionLink, ALinkWhoseSenderSkippedMacrostepsHasNotEndedBeforeItsLastMessage) {
  begin(ClockKind::wall);
  send(1);
  send(7);  // the second message
  out->end();
  arrive();
  EXPECT_TRUE(in->here(7));
  for (const std::int64_t i : {2, 3, 6}) EXPECT_FALSE(in->here(i)) << i;
  EXPECT_TRUE(in->here(8));
}

TEST_F(TransmissionLink, ALinkThatEndsWithoutAMessageHasEndedBeforeEveryMacrostep) {
  begin(ClockKind::step);
  out->end();
  arrive();
  EXPECT_TRUE(in->here(1));
  EXPECT_EQ(in->inbox().counters().received, 1);
}

}  // namespace
}  // namespace mrroc::link
