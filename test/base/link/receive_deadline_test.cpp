// A process that waits for a message that must come reports in time that it does not come.
#include "base/link/receive_deadline.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/instructions.hpp"
#include "base/link/process.hpp"
#include "base/link/senders.hpp"
#include "base/link/text.hpp"
#include "mrroc/operator_order_t.hpp"
#include "test/base/link/buses.hpp"
#include "test/base/link/ring.hpp"

namespace mrroc::link {
namespace {

using namespace std::chrono_literals;
using test::DirectBus;

FaultCode code_of(const ReceiveDeadline& receive_deadline, ReceiveDeadline::Clock::time_point now) {
  try {
    receive_deadline.check(now);
  } catch (const FaultError& e) {
    return e.fault().code;
  }
  return FaultCode::none;
}

struct Channel {
  DirectBus bus;
  Inbox<operator_order_t> in{bus, {Group::agents, "s.a"}, 1};
  Outbox<operator_order_t> out{bus, {Group::agents, "s.a"}, 1};
  Sources sources{nullptr, &in};
};

TEST(ReceiveDeadline, EndsWithWhatTheSilenceMeansAndNotBefore) {
  Channel c;
  c.out.publish({}, 1);
  const ReceiveDeadline receive_deadline(c.sources, FaultCode::hardware_silent, 10s);
  const auto begun = receive_deadline.deadline() - 10s;
  EXPECT_EQ(code_of(receive_deadline, begun), FaultCode::none);
  EXPECT_EQ(code_of(receive_deadline, begun + 9999ms), FaultCode::none);
  EXPECT_EQ(code_of(receive_deadline, begun + 10s), FaultCode::hardware_silent);
}

TEST(ReceiveDeadline, NamesChannelAndCounters) {
  Channel c;
  c.out.publish({}, 1);
  const ReceiveDeadline receive_deadline(c.sources, FaultCode::peer_silent, 10s);
  c.bus.deliver("s.a", test::Bytes(7));
  try {
    receive_deadline.check(receive_deadline.deadline());
    FAIL();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().text.view(),
              "s.a, waited for 10.0 s; 1 message taken, 1 malformed, 0 of another session");
  }
}

TEST(ReceiveDeadline, MalformedMessagesAloneEndItSooner) {
  Channel c;
  c.bus.deliver("s.a", test::Bytes(7));  // before the wait: says nothing about it
  const ReceiveDeadline receive_deadline(c.sources, FaultCode::peer_silent, 10s);
  const auto begun = receive_deadline.deadline() - 10s;
  EXPECT_EQ(code_of(receive_deadline, begun + 3s), FaultCode::none);
  c.bus.deliver("s.a", test::Bytes(7));
  EXPECT_EQ(code_of(receive_deadline, begun + 1s), FaultCode::none);
  EXPECT_EQ(code_of(receive_deadline, begun + 3s), FaultCode::malformed_message);
  c.out.publish({}, 1);  // it speaks after all
  EXPECT_EQ(code_of(receive_deadline, begun + 3s), FaultCode::none);
}

TEST(ReceiveDeadline, MalformedMessagesEndItAfterAFifthOfTheTimeoutExactly) {
  Channel c;
  const ReceiveDeadline receive_deadline(c.sources, FaultCode::peer_silent, 10s);
  const auto begun = receive_deadline.deadline() - 10s;
  c.bus.deliver("s.a", test::Bytes(7));
  EXPECT_EQ(code_of(receive_deadline, begun + 1999ms), FaultCode::none);
  EXPECT_EQ(code_of(receive_deadline, begun + 2s), FaultCode::malformed_message);
}

TEST(ReceiveDeadline, NamesTheFirstSilentOneOfItsFirstEightChannels) {
  DirectBus bus;
  std::vector<std::unique_ptr<Inbox<operator_order_t>>> in;
  std::vector<std::unique_ptr<Outbox<operator_order_t>>> out;
  Sources sources;
  for (int k = 0; k < 12; ++k) {
    const Route route{Group::agents, "s." + std::to_string(k)};
    in.push_back(std::make_unique<Inbox<operator_order_t>>(bus, route, 1));
    out.push_back(std::make_unique<Outbox<operator_order_t>>(bus, route, 1));
    sources.push_back(in.back().get());
  }
  for (const std::size_t silent : {0U, 3U, 7U, 8U, 11U}) {
    const ReceiveDeadline receive_deadline(sources, FaultCode::peer_silent, 10s);
    for (std::size_t k = 0; k < out.size(); ++k)
      if (k != silent) out[k]->publish({}, 1);
    try {
      receive_deadline.check(receive_deadline.deadline());
      ADD_FAILURE() << silent;
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::peer_silent);
      const std::string told(e.fault().text.view());
      EXPECT_TRUE(told.starts_with(silent < 8 ? "s." + std::to_string(silent) + ", waited for 10.0 s"
                                              : "messages come, but not the one"))
          << told;
    }
  }
}

TEST(ReceiveDeadline, WithoutATimeoutItNeverEnds) {
  Channel c;
  const ReceiveDeadline receive_deadline(c.sources, FaultCode::peer_silent, 0s);
  EXPECT_EQ(receive_deadline.deadline(), ReceiveDeadline::Clock::time_point::max());
  EXPECT_EQ(code_of(receive_deadline, ReceiveDeadline::Clock::now() + 1000h), FaultCode::none);
}

TEST(Process, AWaitForAMessageThatNeverComesEndsInAFault) {
  DirectBus bus;
  NodeContext me = test::context_of("b");
  me.timeout = 30ms;
  Process p(bus, me);
  const auto in = p.inbox<operator_order_t>("a.out");
  const Sources sources{in.get()};
  EXPECT_THROW(p.await_from(sources, FaultCode::peer_silent, [&] { return in->at(1) != nullptr; }),
               FaultError);
  Outbox<operator_order_t> out(bus, p.route("a.out"), 1);
  out.publish({}, 1);
  EXPECT_NO_THROW(p.await_from(sources, FaultCode::peer_silent, [&] { return in->at(1) != nullptr; }));
}

TEST(Process, TellsAtTheEndWhatWasWrongOnItsLinks) {
  DirectBus bus;
  Process p(bus, test::context_of("b"));
  const auto good = p.inbox<operator_order_t>("good"), bad = p.inbox<operator_order_t>("bad");
  Queue<console_t> lines(bus, p.route("b.console"), 1);
  Outbox<operator_order_t> out(bus, p.route("good"), 1);
  out.publish({}, 1);
  for (int k = 0; k < 3; ++k) bus.deliver("ring.bad", test::Bytes(5));
  p.report_done();
  const auto line = lines.take();
  ASSERT_TRUE(line);
  EXPECT_EQ(get_text(line->text), "bad: 0 messages taken, 3 malformed, 0 of another session, 0 missing");
  EXPECT_FALSE(lines.take());
}

TEST(Header, IsPlausibleWithinItsBounds) {
  EXPECT_TRUE(plausible({1, 1, -1}, 0));
  EXPECT_TRUE(plausible({1, 1, 0}, 500)) << "an older one";
  EXPECT_FALSE(plausible({1, 0, 0}, 0));
  EXPECT_FALSE(plausible({1, -1, 0}, 0));
  EXPECT_FALSE(plausible({1, 1, -2}, 0));
  EXPECT_TRUE(plausible({1, 1'000'000, 0}, 0));
  EXPECT_FALSE(plausible({1, 1'000'001, 0}, 0));
  EXPECT_TRUE(plausible({1, 1'000'007, 0}, 7));
  EXPECT_TRUE(plausible({1, 1, 1'000'000'000'000}, 0));
  EXPECT_FALSE(plausible({1, 1, 1'000'000'000'001}, 0));
}

constexpr std::array<std::string_view, 1> kVerbs{"tell"};
const RegisteredInstructions kTold{{"senders", "senders.words", kVerbs}};

TEST(Senders, OfOrdersAndOfInstructionsAreSeveral) {
  for (const char* channel : {"s.operator", "press-1a2b.operator", "s.senders.words"})
    EXPECT_TRUE(has_several_senders(channel)) << channel;
  for (const char* channel :
       {"s.operator.image", "s.arm1.operator", "s.senders", "s.words", "s.supervisor", "s."})
    EXPECT_FALSE(has_several_senders(channel)) << channel;
}

}  // namespace
}  // namespace mrroc::link
