#include "base/linked_port.hpp"

#include <gtest/gtest.h>

#include <string>

namespace mrroc {
namespace {

struct Agent {
  struct X {
    int c{}, e{}, V{}, T{}, i{}, i_0{};
  };
  struct Y {
    int c{}, e{}, V{}, T{};
  };
};

/// Tells in which order it is used, and by whom.
struct InnerPort {
  std::string* told;
  Outcome outcome{Outcome::terminated};
  void dispatch(const Motion<Agent>& motion, const Agent::Y& y) {
    *told += "port" + std::to_string(motion.m) + std::to_string(y.e) + " ";
  }
  Outcome wait() const { return outcome; }
  static void read(Agent::X& x) { x.e = x.V = 1; }
};

TEST(LinkedPort, GivesBeforeThePortSendsAndTakesAfterItHasRead) {
  std::string told;
  InnerPort inner{&told};
  LinkedPort port(
      inner, [&told](const Agent::Y& y) { told += "give" + std::to_string(y.e) + " "; },
      [](Agent::X& x) { x.V += 5; });
  static_assert(Port<decltype(port), Agent>);
  Motion<Agent> motion{};
  motion.m = 3;
  port.dispatch(motion, {.e = 7});
  EXPECT_EQ(told, "give7 port37 ");
  Agent::X x;
  port.read(x);
  EXPECT_EQ(x.e, 1);
  EXPECT_EQ(x.V, 6) << "last";
}

TEST(LinkedPort, WaitsAsItsPortDoes) {
  std::string told;
  InnerPort inner{&told};
  LinkedPort port(
      inner, [](const Agent::Y&) {}, [](Agent::X&) {});
  for (const Outcome outcome : {Outcome::terminated, Outcome::aborted, Outcome::faulted}) {
    inner.outcome = outcome;
    EXPECT_EQ(port.wait(), outcome);
  }
}

}  // namespace
}  // namespace mrroc
