// Who waits for a message that must come says in time that it does not.
#include "base/link/vigil.hpp"

#include <gtest/gtest.h>

#include "base/link/process.hpp"
#include "base/link/text.hpp"
#include "mrroc/operator_order_t.hpp"
#include "test/base/link/buses.hpp"
#include "test/base/link/ring.hpp"

namespace mrroc::link {
namespace {

using namespace std::chrono_literals;
using test::DirectBus;

FaultCode code_of(const Vigil& vigil, Vigil::Clock::time_point now) {
  try {
    vigil.check(now);
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

TEST(Vigil, EndsWithWhatTheSilenceMeansAndNotBefore) {
  Channel c;
  c.out.publish({}, 1);
  const Vigil vigil(c.sources, FaultCode::hardware_silent, 10s);
  const auto begun = vigil.deadline() - 10s;
  EXPECT_EQ(code_of(vigil, begun), FaultCode::none);
  EXPECT_EQ(code_of(vigil, begun + 9999ms), FaultCode::none);
  EXPECT_EQ(code_of(vigil, begun + 10s), FaultCode::hardware_silent);
}

TEST(Vigil, NamesChannelAndCounters) {
  Channel c;
  c.out.publish({}, 1);
  const Vigil vigil(c.sources, FaultCode::peer_silent, 10s);
  c.bus.deliver("s.a", test::Bytes(7));
  try {
    vigil.check(vigil.deadline());
    FAIL();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().text.view(),
              "s.a, waited for 10.0 s; 1 messages taken, 1 malformed, 0 of another session");
  }
}

TEST(Vigil, MalformedMessagesAloneEndItSooner) {
  Channel c;
  c.bus.deliver("s.a", test::Bytes(7));  // before the wait: says nothing about it
  const Vigil vigil(c.sources, FaultCode::peer_silent, 10s);
  const auto begun = vigil.deadline() - 10s;
  EXPECT_EQ(code_of(vigil, begun + 3s), FaultCode::none);
  c.bus.deliver("s.a", test::Bytes(7));
  EXPECT_EQ(code_of(vigil, begun + 1s), FaultCode::none);
  EXPECT_EQ(code_of(vigil, begun + 3s), FaultCode::malformed_message);
  c.out.publish({}, 1);  // it speaks after all
  EXPECT_EQ(code_of(vigil, begun + 3s), FaultCode::none);
}

TEST(Vigil, WithoutPatienceItNeverEnds) {
  Channel c;
  const Vigil vigil(c.sources, FaultCode::peer_silent, 0s);
  EXPECT_EQ(vigil.deadline(), Vigil::Clock::time_point::max());
  EXPECT_EQ(code_of(vigil, Vigil::Clock::now() + 1000h), FaultCode::none);
}

TEST(Process, AWaitForAMessageThatNeverComesEndsInAFault) {
  DirectBus bus;
  Membership me = test::member("b");
  me.patience = 30ms;
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
  Process p(bus, test::member("b"));
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

}  // namespace
}  // namespace mrroc::link
