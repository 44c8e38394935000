// The Move instruction over a scripted port: algorithm (10) of MG and its two decided additions, the entry
// and the trigger.
#include "base/motion.hpp"

#include <gtest/gtest.h>

#include "base/script_port.hpp"

namespace mrroc {
namespace {

/// An agent that counts: its effector image is a number that the script gives.
struct Counter {
  struct Memory {
    int entries{};
    int iterations{};
    std::int64_t trigger{};
    std::int64_t began{};
  };
  struct X {
    Memory c;
    int e{};
    int V{};
    std::int64_t T{};  // the operator's trigger number
    std::int64_t i{};
    std::int64_t i_0{};
  };
  struct Y {
    Memory c;
    int e{};
    int V{};
    int T{};
  };
};
using X = Counter::X;
using Memory = Counter::Memory;

Memory enter(const X& x) {
  Memory c = x.c;
  ++c.entries;
  c.trigger = x.T;
  c.began = x.i_0;
  return c;
}
Memory count(const X& x) {
  Memory c = x.c;
  ++c.iterations;
  return c;
}
int copy_e(const X& x) { return 10 * x.e; }
int none(const X&) { return 0; }
int tell_iterations(const X& x) { return x.c.iterations; }

constexpr Motion<Counter> until(int m, bool (*f_tau)(const X&)) {
  return {m, "test", enter, count, copy_e, none, tell_iterations, f_tau};
}
bool at_once(const X&) { return true; }
bool never(const X&) { return false; }
bool e_is_5(const X& x) { return x.e == 5; }
bool triggered(const X& x) { return x.T > x.c.trigger; }
bool after_three(const X& x) { return x.i - x.i_0 >= 3; }

/// Images e = 1, 2, 3 ..., triggers as given.
std::vector<X> script(int n, const std::vector<std::int64_t>& triggers = {}) {
  std::vector<X> images(static_cast<std::size_t>(n));
  for (std::size_t k = 0; k < images.size(); ++k) {
    images[k].e = static_cast<int>(k) + 1;
    if (k < triggers.size()) images[k].T = triggers[k];
  }
  return images;
}

TEST(Move, EntersBeforeTheFirstTestOfTheTerminalCondition) {
  ScriptPort<Counter> port(script(0));
  X x{};
  x.i = 17;
  x.T = 4;
  EXPECT_EQ(move(until(1, at_once), x, port), Outcome::terminated);
  EXPECT_EQ(x.c.entries, 1);
  EXPECT_EQ(x.c.iterations, 0);
  EXPECT_EQ(x.c.trigger, 4);
  EXPECT_EQ(x.c.began, 17);
  EXPECT_EQ(x.i_0, 17);
  EXPECT_TRUE(port.decisions().empty());
}

TEST(Move, DecidesFromTheImageOfTheMacrostepBefore) {
  ScriptPort<Counter> port(script(10));
  X x{};
  EXPECT_EQ(move(until(7, e_is_5), x, port), Outcome::terminated);
  ASSERT_EQ(port.decisions().size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(port.decisions()[k].m, 7);
    EXPECT_EQ(port.decisions()[k].y.e, 10 * static_cast<int>(k));
    EXPECT_EQ(port.decisions()[k].y.T, static_cast<int>(k));  // the memory of before
    EXPECT_EQ(port.decisions()[k].y.c.iterations, static_cast<int>(k) + 1);
  }
}

TEST(Move, LeavesXValidSoThatTheNextCanFollowAtOnce) {
  ScriptPort<Counter> port(script(20));
  X x{};
  ASSERT_EQ(move(until(1, e_is_5), x, port), Outcome::terminated);
  EXPECT_EQ(x.e, 5);
  EXPECT_EQ(x.i, 5);
  EXPECT_EQ(x.c.iterations, 5);
  ASSERT_EQ(move(until(2, after_three), x, port), Outcome::terminated);
  EXPECT_EQ(x.i_0, 5);
  EXPECT_EQ(x.i, 8);
  EXPECT_EQ(x.c.entries, 2);
  EXPECT_EQ(port.decisions().size(), 8U);  // no macrostep between the two
  EXPECT_EQ(port.decisions()[5].m, 2);
  EXPECT_EQ(port.decisions()[5].y.e, 50);
}

TEST(Move, OneTriggerNeverEndsTwoBehaviours) {
  ScriptPort<Counter> port(script(9, {0, 0, 1, 1, 1, 1, 2, 2, 2}));
  X x{};
  ASSERT_EQ(move(until(1, triggered), x, port), Outcome::terminated);
  EXPECT_EQ(x.i, 3);
  ASSERT_EQ(move(until(2, triggered), x, port), Outcome::terminated);
  EXPECT_EQ(x.i, 7);
  EXPECT_EQ(move(until(3, triggered), x, port), Outcome::aborted);
}

Memory one_more(const X& x) {
  return {.entries = x.c.entries + 1, .iterations = 0, .trigger = 0, .began = 0};
}

TEST(Move, EveryPartOfADecisionGoesToItsOwnBuffer) {
  std::vector<X> images(3);
  for (std::size_t k = 0; k < images.size(); ++k) {
    images[k].e = 10 + static_cast<int>(k);
    images[k].V = 20 + static_cast<int>(k);
    images[k].T = 30 + static_cast<std::int64_t>(k);
  }
  ScriptPort<Counter> port(images);
  X x{};
  x.e = 9;
  x.V = 19;
  x.T = 29;
  const Motion<Counter> row{4,
                            "copy",
                            [](const X& y) { return y.c; },
                            one_more,
                            [](const X& y) { return y.e; },
                            [](const X& y) { return y.V; },
                            [](const X& y) { return static_cast<int>(y.T); },
                            never};
  EXPECT_EQ(move(row, x, port), Outcome::aborted);
  ASSERT_EQ(port.decisions().size(), 4U);
  for (int k = 0; k < 4; ++k) {
    const auto& y = port.decisions()[static_cast<std::size_t>(k)].y;
    EXPECT_EQ(y.e, 9 + k);
    EXPECT_EQ(y.V, 19 + k);
    EXPECT_EQ(y.T, 29 + k);
    EXPECT_EQ(y.c.entries, k + 1);
  }
  EXPECT_EQ(x.c.entries, 3) << "the decision that found no image is not remembered";
}

TEST(Move, SaysWhyThePortGaveUpAndKeepsWhatWasReadLast) {
  ScriptPort<Counter> port(script(4));
  X x{};
  EXPECT_EQ(move(until(1, never), x, port), Outcome::aborted);
  EXPECT_EQ(x.e, 4);
  EXPECT_EQ(x.i, 4);
  EXPECT_EQ(x.c.iterations, 4);
}

TEST(Move, TheSameImagesGiveTheSameDecisions) {
  std::vector<int> decided[2];
  for (auto& d : decided) {
    ScriptPort<Counter> port(script(50));
    X x{};
    move(until(1, never), x, port);
    for (const auto& decision : port.decisions()) d.push_back(decision.y.e);
  }
  EXPECT_EQ(decided[0], decided[1]);
}

}  // namespace
}  // namespace mrroc
