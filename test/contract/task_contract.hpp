// Contract of every task's table, as a test suite. An agent of a new task uses it by naming its parts:
//
//   #include "test/contract/task_contract.hpp"
//   struct MyAgent {
//     using Agent = my::Arm;                                             // with X and Y
//     static constexpr const char* kFolder = "tasks/my";                 // with README.md and my.toml
//     static auto behaviours() { return my::kRows; }                     // all Motion<Agent>
//     static Outcome run(Agent::X& x, auto& port) { return my::run_program(x, port); }
//     static void configure(const Config& config) { my::read_parameters(config); }
//   };
//   INSTANTIATE_TYPED_TEST_SUITE_P(My, TaskContract, MyAgent);
//
// More where it is needed: `static auto seen(X& x)`, a tie of everything in x that others have made, when that is not
// x.e, x.V and x.T themselves; `static void limit(X& x)`, which takes back of it what would always end the task;
// `static bool same(const Memory&, const Memory&)`, when c has no operator ==; `static constexpr int kForever`, the number of a behaviour that lasts until the system stops; `static constexpr bool
// kHasNoDefaults`, when the configuration has values that nobody can guess.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "base/config.hpp"
#include "base/motion.hpp"
#include "base/task_clock.hpp"
#include "test/contract/random_image.hpp"

namespace mrroc::contract {

/// Plays a world that does anything at all, and keeps what an agent sees of it.
template <class Case>
class AnythingPort {
 public:
  using A = typename Case::Agent;
  using X = typename A::X;
  using Y = typename A::Y;

  AnythingPort(unsigned seed, std::int64_t macrosteps) : random_(seed), left_(macrosteps) {}

  void dispatch(const Motion<A>& motion, const Y& y) {
    begun.insert(motion.m);
    if (m_ && *m_ != motion.m) ended.insert(*m_);
    m_ = motion.m;
    memory_ = y.c;
  }
  Outcome wait() { return left_-- > 0 ? Outcome::terminated : Outcome::aborted; }
  void read(X& x) {
    ++x.i;
    vary_seen(x, random_);
    if constexpr (requires { x.t; }) {
      clock_.advance(x.T.h.paused, m_.value_or(0));
      x.t = clock_.now();
    }
    X kept = x;
    kept.c = memory_;
    if (seen.size() < kKept || x.i % 50 == 0) seen.push_back(kept);
  }
  /// The program came to its end.
  void finish() {
    if (m_) ended.insert(*m_);
  }

  static void vary_seen(X& x, std::mt19937& random) {
    if constexpr (requires { Case::seen(x); }) {
      std::apply([&](auto&... part) { (vary(part, random), ...); }, Case::seen(x));
    } else {
      vary(x.e, random);
      vary(x.V, random);
      vary(x.T, random);
    }
    if constexpr (requires { Case::limit(x); }) Case::limit(x);
  }

  std::set<int> begun, ended;  ///< numbers of behaviours
  std::vector<X> seen;

 private:
  static constexpr std::size_t kKept = 200;

  std::mt19937 random_;
  std::int64_t left_;
  std::optional<int> m_;
  TaskClock clock_ = TaskClock::ramped();
  decltype(Y::c) memory_{};
};

/// Whether it consists of what messages hold: of each agent, when there may be any number of them.
template <class T>
inline constexpr bool kCanBeSent = std::is_trivially_copyable_v<T>;
template <class T>
inline constexpr bool kCanBeSent<std::vector<T>> = kCanBeSent<T>;
template <class T>
requires requires(T& image) {
  image.agent.data();
  image.h;
}
inline constexpr bool kCanBeSent<T> = kCanBeSent<decltype(T::agent)> && kCanBeSent<decltype(T::h)>;

template <class Case>
class TaskContract : public testing::Test {
 protected:
  using A = typename Case::Agent;
  using X = typename A::X;
  using Port = AnythingPort<Case>;

  static constexpr unsigned kRuns = 5;
  static constexpr std::int64_t kMacrosteps = 20'000;

  static Port run(unsigned seed) {
    Port port(seed, kMacrosteps);
    X x{};
    if (Case::run(x, port) == Outcome::terminated) port.finish();
    return port;
  }
  template <class T>
  static bool alike(const T& a, const T& b) {
    if constexpr (requires { Case::same(a, b); })
      return Case::same(a, b);
    else
      return same(a, b);
  }
  static bool decides_the_same(const Motion<A>& row, const X& x, const X& copy) {
    return alike(row.f_entry(x), row.f_entry(copy)) && alike(row.f_cc(x), row.f_cc(copy)) &&
           alike(row.f_ce(x), row.f_ce(copy)) && alike(row.f_cV(x), row.f_cV(copy)) &&
           alike(row.f_cT(x), row.f_cT(copy)) && row.f_tau(x) == row.f_tau(copy);
  }
  static constexpr bool lasts_forever(int m) {
    if constexpr (requires { Case::kForever; }) return m == Case::kForever;
    return false;
  }
  static std::filesystem::path folder() { return std::filesystem::path(MRROC_SOURCE_DIR) / Case::kFolder; }
};
TYPED_TEST_SUITE_P(TaskContract);

TYPED_TEST_P(TaskContract, HasAWellFormedTable) {
  std::set<int> numbers;
  std::set<std::string_view> names;
  for (const auto& row : TypeParam::behaviours()) {
    SCOPED_TRACE(row.m);
    EXPECT_TRUE(numbers.insert(row.m).second) << "two behaviours of that number";
    EXPECT_FALSE(row.name.empty());
    EXPECT_TRUE(names.insert(row.name).second) << "two behaviours called " << row.name;
    EXPECT_TRUE(row.f_entry && row.f_cc && row.f_ce && row.f_cV && row.f_cT && row.f_tau);
  }
  EXPECT_FALSE(numbers.empty());
}

// In a world that does anything, sooner or later everything happens: what is never begun then cannot be reached, and
// what never ends has no exit.
TYPED_TEST_P(TaskContract, ReachesAndLeavesEveryBehaviour) {
  std::set<int> begun, ended;
  for (unsigned seed = 1; seed <= this->kRuns; ++seed) {
    const auto port = this->run(seed);
    begun.insert(port.begun.begin(), port.begun.end());
    ended.insert(port.ended.begin(), port.ended.end());
  }
  std::set<int> all;
  for (const auto& row : TypeParam::behaviours()) {
    all.insert(row.m);
    EXPECT_TRUE(begun.contains(row.m)) << row.m << ", " << row.name << ", is never reached";
    if (this->lasts_forever(row.m)) continue;
    EXPECT_TRUE(ended.contains(row.m)) << row.m << ", " << row.name << ", has no exit";
  }
  for (const int m : begun) EXPECT_TRUE(all.contains(m)) << m << " is executed, but not in the table";
}

// All functions of all behaviours on all images, also those that belong to other behaviours.
TYPED_TEST_P(TaskContract, DecidesByTheImageAlone) {
  const auto port = this->run(1);
  ASSERT_GT(port.seen.size(), 100u);
  std::mt19937 random(2);
  for (const auto& x : port.seen) {
    const auto copy = x;
    for (const auto& row : TypeParam::behaviours()) {
      auto other = port.seen[random() % port.seen.size()];
      (void)this->decides_the_same(row, other, other);
      ASSERT_TRUE(this->decides_the_same(row, x, copy)) << row.m << ", " << row.name;
    }
    ASSERT_TRUE(this->alike(x.c, copy.c)) << "a function changed the memory that it was given";
  }
}

TYPED_TEST_P(TaskContract, SendsWhatCanBeSent) {
  using Images = typename TypeParam::Agent;
  EXPECT_TRUE(kCanBeSent<decltype(Images::Y::e)>);
  EXPECT_TRUE(kCanBeSent<decltype(Images::Y::V)>);
  EXPECT_TRUE(kCanBeSent<decltype(Images::Y::T)>);
  EXPECT_TRUE(kCanBeSent<decltype(Images::X::e)>);
  EXPECT_TRUE(kCanBeSent<decltype(Images::X::T)>);
}

TYPED_TEST_P(TaskContract, HasAConfigurationThatParses) {
  const std::filesystem::path file = this->folder() / (this->folder().filename().string() + ".toml");
  EXPECT_NO_THROW(TypeParam::configure(Config::load(file)));
  if constexpr (requires { TypeParam::kHasNoDefaults; }) {
    EXPECT_THROW(TypeParam::configure(Config()), FaultError);
  } else {
    EXPECT_NO_THROW(TypeParam::configure(Config())) << "the defaults alone must do";
  }
}

TYPED_TEST_P(TaskContract, SaysWhatItIs) {
  std::ifstream readme(this->folder() / "README.md");
  std::string heading;
  ASSERT_TRUE(std::getline(readme, heading)) << "no README.md";
  EXPECT_TRUE(heading.starts_with("# ") && heading.size() > 10) << heading;
}

REGISTER_TYPED_TEST_SUITE_P(TaskContract, HasAWellFormedTable, ReachesAndLeavesEveryBehaviour,
                            DecidesByTheImageAlone, SendsWhatCanBeSent, HasAConfigurationThatParses,
                            SaysWhatItIs);

}  // namespace mrroc::contract
