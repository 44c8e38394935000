// The client of the command protocol against the driver's side of it, over a link that loses, doubles and
// delays.
#include "ecp/effector_client.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <vector>

#include "base/link/injection.hpp"
#include "edp/protocol.hpp"

namespace mrroc::ecp {
namespace {

constexpr std::int64_t kSession = 5;

/// A control subsystem that commands 1, 2, 3... and a driver that executes them, macrostep by macrostep.
class Line {
 public:
  explicit Line(const link::Injection& injected) : injection(injected) {}

  EffectorClient client{kSession};
  link::Injection injection;
  std::vector<int> executed;             ///< by the driver, in its order
  std::map<std::int64_t, int> attempts;  ///< sendings by number of the command
  int commanded{};

  /// One macrostep i of the control subsystem, and then i + 1 of the driver. Its reply is x_ce of i + 2.
  /// @param active  false: nothing is commanded
  /// @param instruction  what is commanded
  void macrostep(bool active = true, Instruction instruction = Instruction::set_get) {
    client.see(replies_[i_]);
    if (client.fault()) return;
    EffectorCommand wanted;
    if (active) {
      wanted.instruction = instruction;
      wanted.outputs = static_cast<std::uint16_t>(++commanded);
    }
    const EffectorCommand sent = client.next(wanted, ++i_);
    EXPECT_EQ(sent.session, kSession);
    EXPECT_EQ(sent.macrostep, i_);
    if (sent.instruction != Instruction::keep) ++attempts[sent.number];
    sent_[i_] = sent;
    drive(i_);
  }

  /// What the driver has for an answer to the sequence so far.
  [[nodiscard]] bool in_order() const {
    for (std::size_t k = 0; k < executed.size(); ++k)
      if (executed[k] != static_cast<int>(k) + 1) return false;
    return true;
  }
  int refuse{};  ///< so many commands are refused for their content
  [[nodiscard]] const edp::Protocol& protocol() const { return protocol_; }

 private:
  void drive(std::int64_t now) {
    replies_[now + 1].macrostep = now + 1;
    bool taken = false;
    for (std::int64_t s = now - link::Injection::kMaxDelay; s <= now; ++s) {
      const auto fate = injection.fate(s);
      if (s < 1 || s + fate.delay != now) continue;
      for (int copy = 0; copy < fate.copies; ++copy) taken = answer(sent_.at(s), now, taken) || taken;
    }
  }
  /// The protocol sees everything; one command per macrostep is executed, the first that is there.
  bool answer(const EffectorCommand& c, std::int64_t now, bool taken) {
    const auto decision = protocol_.admit(c, false);
    using Admission = edp::Protocol::Admission;
    if (decision.admission == Admission::nothing || taken) return false;
    EffectorReply& reply = replies_[now + 1];
    reply.number = c.number;
    if (decision.admission == Admission::replay) {
      reply = protocol_.stored();
    } else if (decision.admission == Admission::execute) {
      const bool good = refuse == 0 || --refuse < 0;
      protocol_.conclude(c, good);
      reply.verdict = good ? Verdict::executed : Verdict::refused;
      if (!good) reply.fault.code = FaultCode::out_of_limits;
      reply.expected = protocol_.expected();
      executed.push_back(c.outputs);
      protocol_.store(reply);
    } else if (decision.admission == Admission::reset) {
      reply.verdict = Verdict::executed;
      reply.expected = protocol_.expected();
      executed.push_back(c.outputs);
    } else {
      reply.verdict = Verdict::refused;
      reply.fault = decision.fault;
    }
    reply.macrostep = now + 1;
    return true;
  }

  edp::Protocol protocol_;
  std::map<std::int64_t, EffectorCommand> sent_;
  std::map<std::int64_t, EffectorReply> replies_;  // by stamp
  std::int64_t i_{};
};

TEST(EffectorClient, NumbersCommandsOneAfterAnotherAndExecutesEachOnce) {
  Line line({});
  for (int k = 0; k < 1000; ++k) line.macrostep();
  EXPECT_EQ(line.executed.size(), 1000U);
  EXPECT_TRUE(line.in_order());
  EXPECT_EQ(line.client.backlog(), 0U);
  EXPECT_FALSE(line.client.fault());
  for (const auto& [number, times] : line.attempts) EXPECT_EQ(times, 1) << number;
}

TEST(EffectorClient, WhateverNumberACommandBringsItsOwnCountsFromOneOn) {
  EffectorClient client(kSession);
  for (const std::int64_t i : {1, 2, 3}) {
    EffectorCommand wanted;
    wanted.instruction = Instruction::set_get;
    wanted.session = 99;
    wanted.number = 70 + i;
    const EffectorCommand sent = client.next(wanted, i);
    EXPECT_EQ(sent.number, i);
    EXPECT_EQ(sent.session, kSession);
  }
}

TEST(EffectorClient, SilenceUsesUpNoNumber) {
  Line line({});
  for (int k = 0; k < 300; ++k) line.macrostep(k % 3 == 0);
  EXPECT_EQ(line.executed.size(), 100U);
  EXPECT_TRUE(line.in_order());
  EXPECT_TRUE(line.client.settled() || line.client.backlog() == 0);
}

TEST(EffectorClient, GoesBackToTheLostCommandAndKeepsTheOrder) {
  Line line({});
  for (int k = 0; k < 10; ++k) line.macrostep();
  line.injection = {.loss = 1};
  line.macrostep();
  line.injection = {};
  for (int k = 0; k < 10; ++k) line.macrostep();
  EXPECT_TRUE(line.in_order());
  EXPECT_EQ(line.client.backlog(), 2U);  // the lost one and the one sent before that was known
  EXPECT_EQ(line.attempts.at(11), 2);
  for (int k = 0; k < 4; ++k) line.macrostep(false);
  EXPECT_EQ(line.executed.size(), 21U);
  EXPECT_TRUE(line.client.settled());
}

TEST(EffectorClient, LossDuplicationAndDelayNeverChangeWhatIsExecuted) {
  std::size_t executed = 0;
  int faults = 0, repeated = 0;
  std::int64_t seen_twice = 0, lost = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Line line({.loss = 0.01, .duplication = 0.02, .delay = 0.02, .max_delay = 4, .seed = seed});
    for (int k = 0; k < 2000 && !line.client.fault(); ++k) {
      line.macrostep(k % 7 != 0);
      ASSERT_TRUE(line.in_order()) << "seed " << seed << " macrostep " << k;
    }
    executed += line.executed.size();
    seen_twice += line.protocol().repeated();
    lost += line.protocol().lost();
    for (const auto& [number, times] : line.attempts) repeated += times > 1;
    if (line.client.fault()) {
      ++faults;
      continue;
    }
    line.injection = {};
    for (int k = 0; k < 2000 && !line.client.settled(); ++k) line.macrostep(false);
    EXPECT_EQ(line.executed.size(), static_cast<std::size_t>(line.commanded)) << "seed " << seed;
    EXPECT_TRUE(line.in_order());
  }
  EXPECT_GT(executed, 70000U);
  EXPECT_GT(repeated, 1000);
  EXPECT_GT(seen_twice, 1000);
  EXPECT_GT(lost, 1000);
  EXPECT_LT(faults, 15);
}

TEST(EffectorClient, ThreeFailuresInARowAreASystemError) {
  Line line({});
  for (int k = 0; k < 5; ++k) line.macrostep();
  line.injection = {.loss = 1};
  int macrosteps = 0;
  while (!line.client.fault() && macrosteps < 20) {
    line.macrostep();
    ++macrosteps;
  }
  ASSERT_TRUE(line.client.fault());
  EXPECT_EQ(line.client.fault()->code, FaultCode::command_repeated_refused);
  EXPECT_EQ(class_of(line.client.fault()->code), FaultClass::system);
  EXPECT_EQ(line.client.fault()->limit, EffectorClient::kAttempts);
  EXPECT_EQ(line.client.fault()->value, 6) << "which command";
  EXPECT_EQ(line.client.fault()->text.view(), "the driver did not see it");
  EXPECT_EQ(line.attempts.at(6), 3);
  EXPECT_TRUE(line.in_order());
}

TEST(EffectorClient, TwoFailuresInARowAreForgottenAfterASuccess) {
  Line line({});
  for (int round = 0; round < 20; ++round) {
    for (int k = 0; k < 5; ++k) line.macrostep();
    // The attempts at one command are two macrosteps apart.
    for (const double loss : {1.0, 0.0, 1.0}) {
      line.injection = {.loss = loss};
      line.macrostep();
    }
    line.injection = {};
    for (int k = 0; k < 5; ++k) line.macrostep();
    ASSERT_FALSE(line.client.fault()) << round;
    ASSERT_TRUE(line.in_order());
  }
}

TEST(EffectorClient, ARefusalOfTheContentIsFinalAndNotRepeated) {
  Line line({});
  line.macrostep();
  line.refuse = 1;
  for (int k = 0; k < 10; ++k) line.macrostep();
  EXPECT_TRUE(line.in_order());
  EXPECT_EQ(line.executed.size(), 11U);
  for (const auto& [number, times] : line.attempts) EXPECT_EQ(times, 1);
  EXPECT_FALSE(line.client.fault());
}

TEST(EffectorClient, GoesOnWhenTheVeryFirstCommandsAreRefused) {
  for (const int refused : {1, 2, 5, 20}) {
    Line line({});
    line.refuse = refused;
    for (int k = 0; k < 60; ++k) line.macrostep(k < 40);
    EXPECT_FALSE(line.client.fault()) << refused;
    ASSERT_FALSE(line.executed.empty()) << "a driver without an owner does not count what it refuses";
    EXPECT_EQ(line.executed.back(), 40) << refused;
    for (std::size_t k = 1; k < line.executed.size(); ++k)
      ASSERT_EQ(line.executed[k], line.executed[k - 1] + 1) << "none is left out, none comes twice";
  }
}

TEST(EffectorClient, GoesOnAfterAReset) {
  for (const int before : {0, 1, 7}) {
    Line line({});
    for (int k = 0; k < before; ++k) line.macrostep();
    line.macrostep(true, Instruction::reset);
    for (int k = 0; k < 60; ++k) line.macrostep(k < 20);
    EXPECT_FALSE(line.client.fault()) << before;
    EXPECT_EQ(line.executed.size(), static_cast<std::size_t>(before + 21)) << "a driver counts from 1 again";
    EXPECT_TRUE(line.in_order()) << before;
    EXPECT_EQ(line.client.backlog(), 0U);
  }
}

}  // namespace
}  // namespace mrroc::ecp
