// What the client of the command protocol makes of answers that are late, skipped, of another macrostep, or
// a refusal.
#include "ecp/effector_client.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <vector>

#include "edp/protocol.hpp"

namespace mrroc::ecp {
namespace {

constexpr std::int64_t kSession = 5;

TEST(EffectorClient, TheFaultHasTheWordsOfTheDriverThatRefused) {
  EffectorClient client(kSession);
  client.next({.instruction = Instruction::set}, 1);
  for (std::int64_t i = 2; !client.fault() && i < 20; ++i) {
    EffectorReply reply;
    reply.macrostep = i;
    reply.verdict = Verdict::refused;
    reply.fault.code = FaultCode::lost_command;
    reply.fault.text = "number 1 is missing";
    client.see(reply);
    if (!client.fault()) client.next({}, i + 1);
  }
  ASSERT_TRUE(client.fault());
  EXPECT_EQ(client.fault()->text.view(), "number 1 is missing");
}

TEST(EffectorClient, AnswersOfAnotherMacrostepSayNothing) {
  EffectorClient client(kSession);
  client.next({.instruction = Instruction::set}, 1);
  EffectorReply reply;
  reply.verdict = Verdict::executed;
  reply.number = 1;
  for (const std::int64_t macrostep : {-1000, 0, 1, 18, 1000}) {
    reply.macrostep = macrostep;
    client.see(reply);
    EXPECT_FALSE(client.settled()) << macrostep;
  }
  reply.macrostep = 2;
  client.see(reply);
  EXPECT_TRUE(client.settled());
}

TEST(EffectorClient, ReleaseIsSentAtOnceWhateverElseWaits) {
  EffectorClient client(kSession);
  client.next({.instruction = Instruction::set}, 1);
  EffectorReply nothing;
  nothing.macrostep = 2;
  client.see(nothing);
  EXPECT_EQ(client.backlog(), 1U);
  EXPECT_EQ(client.next({.instruction = Instruction::release}, 3).instruction, Instruction::release);
}

TEST(EffectorClient, ALateCommandIsSentAgainForALaterMacrostepAndIsNoFailure) {
  constexpr int kLateAttempts = 20;
  EffectorClient client(kSession, kLateAttempts);
  EffectorCommand sent = client.next({.instruction = Instruction::set}, 1);
  EffectorReply nothing;
  nothing.session = kSession;
  nothing.expected = 1;
  for (std::int64_t i = 2; i < 2 * kLateAttempts; i += 2) {
    nothing.macrostep = i;
    client.see(nothing);
    EXPECT_FALSE(client.fault()) << i;
    sent = client.next({}, i + 1);
    EXPECT_EQ(sent.number, 1);
    EXPECT_EQ(sent.macrostep, i + 1);
    nothing.macrostep = i + 1;
    client.see(nothing);
    client.next({}, i + 2);
  }
  nothing.macrostep = 2 * kLateAttempts;
  client.see(nothing);
  ASSERT_TRUE(client.fault()) << "a link that carries nothing at all";
  EXPECT_EQ(client.fault()->code, FaultCode::command_repeated_refused);
}

TEST(EffectorClient, LatenessThatASuccessEndsIsForgottenHoweverOftenItComes) {
  constexpr int kLateAttempts = 4;
  EffectorClient client(kSession, kLateAttempts);
  EffectorReply reply;
  reply.session = kSession;
  std::int64_t i = 1;
  for (std::int64_t number = 1; number <= 20; ++number) {
    client.next({.instruction = Instruction::set}, i);
    for (int late = 1; late < kLateAttempts; ++late) {  // one sending less than kLateAttempts
      reply.expected = number;
      reply.macrostep = i + 1;
      client.see(reply);
      ASSERT_FALSE(client.fault()) << number;
      i += 2;
      ASSERT_EQ(client.next({}, i).number, number);
    }
    reply.expected = number + 1;
    reply.macrostep = ++i;
    client.see(reply);
    ASSERT_TRUE(client.settled());
  }
  EXPECT_FALSE(client.fault());
}

TEST(EffectorClient, AfterAnySuccessesTheFaultComesWithTheLastOfAsManyFailuresInARowAsAreAgreed) {
  std::mt19937_64 random(1);
  for (const int late_attempts : {0, 1, 2, 3, 7, 50}) {
    const int agreed = late_attempts == 0 ? EffectorClient::kAttempts : late_attempts;
    EffectorClient client(kSession, late_attempts);
    std::int64_t i = 1, number = 0;
    const auto fail = [&] {
      EffectorReply unseen;
      unseen.session = kSession;
      unseen.macrostep = i + 1;
      unseen.expected = number;
      client.see(unseen);
      i += 2;
      if (!client.fault()) client.next({}, i);
    };
    for (int success = 0; success < 20; ++success) {
      client.next({.instruction = Instruction::set}, i);
      ++number;
      const int failures = std::uniform_int_distribution(0, agreed - 1)(random);
      for (int k = 0; k < failures; ++k) fail();
      ASSERT_FALSE(client.fault()) << failures << " of " << agreed;
      EffectorReply executed;
      executed.session = kSession;
      executed.macrostep = ++i;
      executed.verdict = Verdict::executed;
      executed.number = number;
      executed.expected = number + 1;
      client.see(executed);
      ASSERT_TRUE(client.settled());
    }
    client.next({.instruction = Instruction::set}, i);
    ++number;
    int failures = 0;
    for (; !client.fault() && failures < 2 * agreed; ++failures) fail();
    EXPECT_EQ(failures, agreed) << late_attempts;
    ASSERT_TRUE(client.fault());
    EXPECT_EQ(client.fault()->value, static_cast<double>(number));
  }
}

TEST(EffectorClient, AReplyAfterSkippedMacrostepsSaysWhatHasBeenExecuted) {
  EffectorClient client(kSession, 50);
  for (std::int64_t i = 1; i <= 3; ++i) client.next({.instruction = Instruction::set}, i);
  EffectorReply reply;
  reply.session = kSession;
  reply.macrostep = 40;
  reply.expected = 3;
  client.see(reply);
  EXPECT_FALSE(client.settled());
  reply.macrostep = 80;
  reply.expected = 4;
  client.see(reply);
  EXPECT_TRUE(client.settled());
  EXPECT_EQ(client.next({.instruction = Instruction::set}, 81).number, 4);
}

TEST(EffectorClient, ACommandWhoseAnswerWasSkippedIsSentAgain) {
  EffectorClient client(kSession, 50);
  client.next({.instruction = Instruction::synchro}, 2);
  client.next({}, 3);
  EffectorReply reply;  // of macrostep 4; what came in 3 was passed over
  reply.macrostep = 4;
  reply.expected = 1;
  client.see(reply);
  const EffectorCommand again = client.next({}, 5);
  EXPECT_EQ(again.instruction, Instruction::synchro);
  EXPECT_EQ(again.number, 1);
  EXPECT_FALSE(client.fault());
}

TEST(EffectorClient, WithTheWallClockEveryCommandIsExecutedOnceAndInOrderWhateverIsLateOrSkipped) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    std::mt19937_64 random(seed);
    const auto chance = [&](double p) { return std::bernoulli_distribution(p)(random); };
    std::uniform_real_distribution<> share(0, 0.5);
    double late = share(random), passed_over = share(random), missed = share(random);
    EffectorClient client(kSession, 1000);
    edp::Protocol protocol;
    std::vector<int> executed;
    std::map<std::int64_t, EffectorReply> replies{{1, {}}};
    int commanded = 0;
    for (std::int64_t i = 1; i <= 700; ++i) {
      const bool ends = i > 360;
      if (ends) late = passed_over = missed = 0;
      std::optional<EffectorCommand> sent;
      if (replies.contains(i) && !chance(passed_over)) {
        client.see(replies.at(i));
        EffectorCommand wanted;
        if (!ends && chance(0.4)) {
          wanted.instruction = Instruction::set_get;
          wanted.outputs = static_cast<std::uint16_t>(++commanded);
        }
        sent = client.next(wanted, i + 1);
      }
      if (chance(missed)) continue;  // by the driver, the macrostep i + 1
      EffectorReply& reply = replies[i + 2];
      reply.macrostep = i + 2;
      if (sent && !chance(late)) {
        const auto decision = protocol.admit(*sent, false);
        using Admission = edp::Protocol::Admission;
        if (decision.admission == Admission::execute) {
          protocol.conclude(*sent, true);
          executed.push_back(sent->outputs);
        }
        if (decision.admission != Admission::nothing) {
          reply.number = sent->number;
          reply.verdict = decision.admission == Admission::refuse ? Verdict::refused : Verdict::executed;
          reply.fault = decision.fault;
        }
      }
      reply.session = executed.empty() ? 0 : kSession;
      reply.expected = protocol.expected();
    }
    EXPECT_FALSE(client.fault()) << "seed " << seed;
    EXPECT_TRUE(client.settled()) << "seed " << seed;
    ASSERT_EQ(executed.size(), static_cast<std::size_t>(commanded)) << "seed " << seed;
    for (int k = 0; k < commanded; ++k)
      ASSERT_EQ(executed[static_cast<std::size_t>(k)], k + 1) << "seed " << seed;
  }
}

}  // namespace
}  // namespace mrroc::ecp
