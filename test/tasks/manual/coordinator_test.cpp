// The coordinator of manual operation by value: what reaches the arms, and when it is over.
#include "tasks/manual/coordinator.hpp"

#include <gtest/gtest.h>

namespace mrroc::manual {
namespace {

using X = Coordinator::X;

/// Two arms that have done the orders with the numbers 5 and 8.
X image() {
  X x;
  x.c.given.resize(2);
  x.T.agent.resize(2);
  x.T.hands.orders.resize(2);
  for (const std::size_t arm : {0U, 1U}) {
    x.c.given[arm].number = x.T.agent[arm].event = arm == 0 ? 5 : 8;
    x.c.given[arm].kind = Kind::bias;
  }
  return x;
}

TEST(ManualCoordinator, AnOrderGetsTheNextNumberOfItsArmAndTheOtherArmKeepsIts) {
  X x = image();
  x.T.hands.orders[1] = ManualOrder{.kind = Kind::reset};
  const auto said = kManualOperation.f_cT(x);
  ASSERT_EQ(said.manual.size(), 2U);
  EXPECT_EQ(said.manual[0].number, 5);
  EXPECT_EQ(said.manual[0].kind, Kind::bias);
  EXPECT_EQ(said.manual[1].number, 9);
  EXPECT_EQ(said.manual[1].kind, Kind::reset);
  const auto memory = kManualOperation.f_cc(x);
  EXPECT_EQ(memory.given[0].number, 5);
  EXPECT_EQ(memory.given[1].number, 9);
  EXPECT_EQ(kManualOperation.f_entry(x).given[1].number, 8) << "before the first macrostep nothing is given";
}

TEST(ManualCoordinator, ArmsWorkUnlessTheOperatorHasMadeAPause) {
  for (const bool paused : {false, true}) {
    X x = image();
    x.T.h.paused = paused;
    const auto said = kManualOperation.f_cT(x);
    ASSERT_EQ(said.order.size(), 2U);
    for (const Order& o : said.order) {
      EXPECT_EQ(o.m, static_cast<int>(paused ? SoloOrder::pause : SoloOrder::work));
      EXPECT_FALSE(o.finished);
    }
  }
}

TEST(ManualCoordinator, IsOverWhenTheOperatorEndsItAndEveryArmHasDoneItsLastOrder) {
  for (const bool end : {false, true})
    for (const bool first : {false, true})
      for (const bool second : {false, true}) {
        X x = image();
        x.T.hands.end = end;
        if (!first) --x.T.agent[0].event;
        if (!second) --x.T.agent[1].event;
        EXPECT_EQ(kManualOperation.f_tau(x), end && first && second);
      }
}

TEST(ManualCoordinator, TheLastOrderEndsTheTaskAndAPauseToo) {
  X x = image();
  x.T.h.paused = true;
  x.T.hands.orders[0] = ManualOrder{.kind = Kind::reset};
  const auto said = farewell(x);
  ASSERT_EQ(said.order.size(), 2U);
  for (const Order& o : said.order) {
    EXPECT_TRUE(o.finished);
    EXPECT_EQ(o.m, static_cast<int>(SoloOrder::work));
  }
  EXPECT_EQ(said.manual[0].number, 5) << "nothing new";
  EXPECT_EQ(said.manual[1].number, 8);
}

}  // namespace
}  // namespace mrroc::manual
