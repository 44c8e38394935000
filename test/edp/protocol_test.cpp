// The table of the protocol against an independent model, and its rows one by one.
#include "edp/protocol.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <utility>

namespace mrroc::edp {
namespace {

using Admission = Protocol::Admission;

EffectorCommand command(std::int64_t session, std::int64_t number, Instruction i = Instruction::set) {
  EffectorCommand c;
  c.session = session;
  c.number = number;
  c.instruction = i;
  return c;
}

/// Takes a command and says what became of it, as a driver does.
Protocol::Decision give(Protocol& p, const EffectorCommand& c, bool good = true) {
  const Protocol::Decision d = p.admit(c, false);
  if (d.admission == Admission::execute) {
    p.conclude(c, good);
    if (p.owner()) {
      EffectorReply reply{};
      reply.session = c.session;
      reply.number = c.number;
      reply.verdict = good ? Verdict::executed : Verdict::refused;
      p.store(reply);
    }
  }
  return d;
}

TEST(Protocol, NumbersAreExecutedOneAfterAnother) {
  Protocol p;
  for (std::int64_t n = 1; n <= 100; ++n) {
    EXPECT_EQ(p.expected(), n);
    EXPECT_EQ(give(p, command(5, n)).admission, Admission::execute);
    EXPECT_EQ(p.owner(), 5);
  }
}

TEST(Protocol, RepeatedNumberGetsTheStoredReplyAndIsNotExecuted) {
  Protocol p;
  give(p, command(5, 1));
  give(p, command(5, 2));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(give(p, command(5, 2)).admission, Admission::replay);
  EXPECT_EQ(p.stored().number, 2);
  EXPECT_EQ(p.expected(), 3);
}

TEST(Protocol, GapIsRefusedAndNamesTheExpectedNumber) {
  Protocol p;
  give(p, command(5, 1));
  for (const std::int64_t n : {3, 100, -1, 0}) {
    const Protocol::Decision d = give(p, command(5, n));
    EXPECT_EQ(d.admission, Admission::refuse);
    EXPECT_EQ(d.fault.code, FaultCode::lost_command);
    EXPECT_EQ(d.fault.limit, 2);
    EXPECT_EQ(d.fault.text.view(), "expected number: 2");
  }
  EXPECT_EQ(give(p, command(5, 2)).admission, Admission::execute);
}

TEST(Protocol, AnotherSessionIsRefusedAndToldTheOwner) {
  Protocol p;
  give(p, command(5, 1));
  for (const std::int64_t n : {1, 2}) {
    const Protocol::Decision d = give(p, command(6, n));
    EXPECT_EQ(d.fault.code, FaultCode::not_owner);
    EXPECT_EQ(d.fault.text.view(), "owner: session 5");
    EXPECT_EQ(d.fault.value, 0) << "no number is wrong";
    EXPECT_EQ(d.fault.limit, 0);
    EXPECT_EQ(d.fault.axis, -1);
  }
  EXPECT_EQ(give(p, command(5, 2)).admission, Admission::execute);
}

TEST(Protocol, SessionEndsByReleaseOfItsOwnerByResetAndByHisDeath) {
  Protocol p;
  give(p, command(5, 1));
  EXPECT_EQ(give(p, command(6, 0, Instruction::release)).admission, Admission::nothing);
  EXPECT_EQ(p.owner(), 5) << "nobody releases for another one";
  give(p, command(5, 1, Instruction::release));
  EXPECT_EQ(p.owner(), std::nullopt);
  EXPECT_EQ(give(p, command(6, 1)).admission, Admission::execute);
  EXPECT_EQ(give(p, command(99, -3, Instruction::reset)).admission, Admission::reset);
  EXPECT_EQ(give(p, command(7, 1)).admission, Admission::execute);
  p.drop_owner();
  EXPECT_EQ(give(p, command(8, 1)).admission, Admission::execute);
}

TEST(Protocol, RefusedCommandUsesItsNumberUpButMakesNobodyTheOwner) {
  Protocol p;
  EXPECT_EQ(give(p, command(5, 1), false).admission, Admission::execute);
  EXPECT_EQ(p.owner(), std::nullopt);
  EXPECT_EQ(p.expected(), 1);
  give(p, command(5, 1));
  give(p, command(5, 2), false);
  EXPECT_EQ(p.expected(), 3);
  EXPECT_EQ(give(p, command(5, 2)).admission, Admission::replay);
  EXPECT_EQ(p.stored().verdict, Verdict::refused);
}

TEST(Protocol, QueryReturnsTheReplyOfItsNumberAndAdvancesNothing) {
  Protocol p;
  EffectorCommand query = command(5, 0, Instruction::query);
  query.queried = 0;
  const Fault none = give(p, query).fault;
  EXPECT_EQ(none.code, FaultCode::unknown_number) << "there is no reply yet";
  EXPECT_EQ(none.text.view(), "last number: 0");
  give(p, command(5, 1));
  give(p, command(5, 2));
  query.queried = 2;
  EXPECT_EQ(give(p, query).admission, Admission::replay);
  query.queried = 1;
  const Fault old = give(p, query).fault;
  EXPECT_EQ(old.code, FaultCode::unknown_number);
  EXPECT_EQ(old.text.view(), "last number: 2");
  query.session = 6;
  query.queried = 2;
  EXPECT_EQ(give(p, query).fault.code, FaultCode::not_owner);
  EXPECT_EQ(p.expected(), 3);
}

TEST(Protocol, EverythingIsRefusedWhileLeftOversMayCome) {
  Protocol p;
  for (const Instruction i : {Instruction::set, Instruction::get, Instruction::set_get, Instruction::synchro,
                              Instruction::query, Instruction::reset}) {
    const Protocol::Decision d = p.admit(command(5, 1, i), true);
    EXPECT_EQ(d.admission, Admission::refuse);
    EXPECT_EQ(d.fault.code, FaultCode::start_guard);
  }
  EXPECT_EQ(p.admit(command(5, 1, Instruction::keep), true).admission, Admission::nothing);
  EXPECT_EQ(p.owner(), std::nullopt);
}

/// What must be true, said with sets of everything that ever happened.
class Model {
 public:
  Admission expect(const EffectorCommand& c, bool good, FaultCode& code) {
    code = FaultCode::none;
    const bool mine = holder_.has_value() && holder_ == c.session;
    const bool other = holder_.has_value() && !mine;
    switch (c.instruction) {
      case Instruction::keep:
        return Admission::nothing;
      case Instruction::release:
        if (mine) free();
        return Admission::nothing;
      case Instruction::reset:
        free();
        return Admission::reset;
      case Instruction::query:
        if (last_ == std::pair{c.session, c.queried}) return Admission::replay;
        code = other ? FaultCode::not_owner : FaultCode::unknown_number;
        return Admission::refuse;
      default:
        break;
    }
    if (other) {
      code = FaultCode::not_owner;
      return Admission::refuse;
    }
    const std::int64_t highest = used_.empty() ? 0 : *used_.rbegin();
    if (c.number == highest + 1) {
      if (good || mine) {
        holder_ = c.session;
        used_.insert(c.number);
        last_ = {c.session, c.number};
        if (good) ++executed_[{c.session, c.number}];
      }
      return Admission::execute;
    }
    if (mine && c.number == highest) return Admission::replay;
    code = FaultCode::lost_command;
    return Admission::refuse;
  }
  [[nodiscard]] std::optional<std::int64_t> holder() const { return holder_; }
  [[nodiscard]] std::int64_t expected() const { return used_.empty() ? 1 : *used_.rbegin() + 1; }

 private:
  void free() {
    holder_.reset();
    used_.clear();
  }
  std::optional<std::int64_t> holder_;
  std::set<std::int64_t> used_;
  std::pair<std::int64_t, std::int64_t> last_{-1, -1};
  std::map<std::pair<std::int64_t, std::int64_t>, int> executed_;
};

TEST(Protocol, AgreesWithTheModelOverAMillionRandomEvents) {
  std::mt19937_64 random(1);
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  Protocol p;
  Model model;
  int executed = 0;
  for (int k = 0; k < 1'000'000; ++k) {
    EffectorCommand c;
    c.session = p.owner() && pick(4) != 0 ? *p.owner() : 1 + pick(3);
    c.number = p.expected() + (pick(3) == 0 ? pick(7) - 4 : 0);
    c.queried = p.expected() - pick(3);
    const int kind = pick(200);
    c.instruction = kind == 0    ? Instruction::reset
                    : kind == 1  ? Instruction::release
                    : kind < 20  ? Instruction::query
                    : kind < 40  ? Instruction::keep
                    : kind == 41 ? static_cast<Instruction>(200)
                                 : Instruction::set;
    const bool good = pick(5) != 0;
    FaultCode code{};
    const Admission expected = model.expect(c, good, code);
    const Protocol::Decision d = give(p, c, good);
    ASSERT_EQ(d.admission, expected) << k;
    ASSERT_EQ(d.fault.code, code) << k;
    ASSERT_EQ(p.owner(), model.holder()) << k;
    ASSERT_EQ(p.expected(), model.expected()) << k;
    executed += d.admission == Admission::execute && good;
  }
  EXPECT_GT(executed, 300'000) << "the events must get through, or nothing was tested";
}

}  // namespace
}  // namespace mrroc::edp
