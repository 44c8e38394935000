// Fragments are handed over once and in order, whatever becomes of messages on their way.
#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "test/edp/platform/platform_rig.hpp"

namespace mrroc::edp::test {
namespace {

#ifdef MRROC_SANITIZED
constexpr int kSequences = 2'000;
#else
constexpr int kSequences = 100'000;
#endif

/// A control subsystem that hands fragments over when the driver is ready for them: its number of those notified equals that
/// of those handed over. It repeats a command until its reply has come. It is so slow that a fragment may also begin at rest,
/// when messages were late.
class Sender {
 public:
  explicit Sender(const PathPoint& from, std::int64_t number) : way_(from), number_(number) {}

  /// @return what it says in this macrostep  @param more  it has another fragment
  PlatformCommand say(bool more, std::mt19937_64& random) {
    if (!waiting_ && notified_ == way_.number && more) {
      const auto steps = static_cast<std::int32_t>(2 + random() % 8);
      open_ = {};
      open_.session = 7;
      open_.number = ++number_;
      open_.instruction = Instruction::set;
      open_.fragment = way_.next(0.04 * static_cast<double>(random() % 3), 0, steps,
                                 static_cast<std::int32_t>(random() % static_cast<unsigned>(steps)));
      waiting_ = true;
    }
    PlatformCommand c = open_;
    if (!waiting_) c.instruction = Instruction::keep;
    c.session = 7;
    c.number = number_;
    return c;
  }
  void hear(const PlatformReply& reply) {
    if (waiting_ && reply.number == number_ && reply.verdict != Verdict::none) {
      waiting_ = reply.fault.code == FaultCode::lost_command;
      refused_ += reply.verdict == Verdict::refused && !waiting_;
    }
    notified_ = std::max(notified_, reply.notified);
  }
  [[nodiscard]] std::int64_t handed() const { return way_.number; }
  [[nodiscard]] bool waiting() const { return waiting_; }
  [[nodiscard]] int refused() const { return refused_; }

 private:
  Way way_;
  PlatformCommand open_{};
  std::int64_t number_;
  std::int64_t notified_{};
  bool waiting_{};
  int refused_{};
};

/// Loses, repeats and delays messages, one way.
template <class Message>
class Link {
 public:
  Link(std::mt19937_64& random, bool disturbed) : random_(random), disturbed_(disturbed) {}
  void send(const Message& m) {
    const auto kind = disturbed_ ? random_() % 10 : 9;
    if (kind == 0) return;
    if (kind == 1) late_.push_back({now_ + 1 + static_cast<int>(random_() % 3), m});
    if (kind != 1) late_.push_back({now_, m});
    if (kind == 2) late_.push_back({now_, m});
  }
  /// @return what comes in this macrostep
  std::deque<Message> receive() {
    std::deque<Message> result;
    for (auto it = late_.begin(); it != late_.end();)
      if (it->first <= now_) {
        result.push_back(it->second);
        it = late_.erase(it);
      } else {
        ++it;
      }
    ++now_;
    return result;
  }

 private:
  std::mt19937_64& random_;
  bool disturbed_;
  std::deque<std::pair<int, Message>> late_;
  int now_{};
};

TEST(Handshake, EveryFragmentIsDrivenOnceAndInOrderOverLossRepetitionAndDelay) {
  std::mt19937_64 random(1);
  PlatformDriverParameters p = PlatformRig::parameters();
  p.silence = 1'000'000;
  auto rig = std::make_unique<PlatformRig>(p);
  ASSERT_TRUE(rig->synchronise());
  std::int64_t session_numbers = rig->number;
  auto sender = std::make_unique<Sender>(PathPoint{rig->driver.estimate().estimate.p, 0, 0}, session_numbers);
  Link<PlatformCommand> down(random, true);
  Link<PlatformReply> up(random, true);
  std::int64_t executing = 0;
  for (int sequence = 0; sequence < kSequences; ++sequence) {
    down.send(sender->say(true, random));
    std::int64_t taken = rig->driver.reply().accepted;
    for (const PlatformCommand& c : down.receive()) rig->driver.take(c);
    const PlatformReply reply = rig->quiet();
    ASSERT_LE(reply.accepted, sender->handed());
    ASSERT_LE(reply.accepted, taken + 1) << "one in a macrostep";
    ASSERT_LE(reply.notified, reply.accepted);
    ASSERT_GE(reply.accepted, sender->handed() - 1) << "never two on their way";
    if (reply.executing != 0) {
      ASSERT_TRUE(reply.executing == executing || reply.executing == executing + 1);
      executing = reply.executing;
    }
    up.send(reply);
    for (const PlatformReply& r : up.receive()) sender->hear(r);
    ASSERT_EQ(sender->refused(), 0) << sequence;
    ASSERT_NE(rig->driver.state(), DriverState::faulted) << rig->driver.fault().text.view();
  }
  EXPECT_GT(executing, kSequences / 30) << "the fragments must get through, or nothing was tested";
  EXPECT_GT(rig->driver.protocol().repeated(), kSequences / 100);
}

TEST(Handshake, WithoutDisturbanceNoFragmentIsLate) {
  std::mt19937_64 random(2);
  PlatformRig rig;
  ASSERT_TRUE(rig.synchronise());
  Way way = rig.way();
  rig.macrostep(rig.set(way.next(0.3, 0, 60, 30)));
  std::int64_t handed = 1;
  std::deque<PlatformReply> replies(2);  // two macrosteps old
  for (int k = 0; k < 400; ++k) {
    const bool ready = replies.front().notified == handed;
    replies.pop_front();
    if (ready) ++handed;
    replies.push_back(rig.macrostep(ready ? rig.set(way.next(0.3, 0, 60, 30)) : rig.keep()));
    ASSERT_EQ(replies.back().state, DriverState::executing);
    ASSERT_LE(handed - replies.back().executing, 1) << "ready is a number: nothing is handed over twice";
    ASSERT_GE(replies.back().remaining, 20);
  }
  EXPECT_GT(handed, 5);
}

}  // namespace
}  // namespace mrroc::edp::test
