// The scripted operator: leads the hands through the behaviours and gives start and triggers.
#include "tasks/drawing/hand_operator.hpp"

#include <gtest/gtest.h>

#include "base/hand.hpp"
#include "mrroc/hand_order_t.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::drawing {
namespace {

/// A command_server, an operator and the simulator's hands.
struct Scene {
  explicit Scene(const HandPlan& plan = {})
      : process(bus,
                [] {
                  link::NodeContext m;
                  m.session = "s";
                  m.name = "mp";
                  m.roster = {"mp"};
                  return m;
                }()),
        command_server(process, {}, {}),
        human(process, command_server, plan),
        orders(bus, process.route("hand.order"), 1),
        reports(bus, process.route("hand.report"), 1) {}

  /// One macrostep in behaviour m. @return what the hands are ordered
  hand_order_t macrostep(int m, bool done_1, bool done_2) {
    ++i;
    human.inform(i, m);
    hand_report_t r{};
    r.done[0] = done_1;
    r.done[1] = done_2;
    r.progress[0] = 0.25;
    EXPECT_FALSE(human.here(i));
    reports.publish(r, i);
    EXPECT_TRUE(human.here(i));
    image = human.image(i);
    const auto order = orders.take();
    EXPECT_TRUE(order);
    EXPECT_EQ(order->header.stamp, i);
    // As the coordinator does in the first macrostep of a behaviour.
    if (m != m_ && waits_) command_server.set_state(TaskState::running, *waits_);
    m_ = m;
    return *order;
  }
  void running(bool waits = true) {
    waits_ = waits;
    command_server.set_state(TaskState::running, waits);
  }

  link::test::DirectBus bus;
  link::Process process;
  mp::OperatorCommandServer command_server;
  HandOperator human;
  link::Queue<hand_order_t> orders;
  link::Outbox<hand_report_t> reports;
  OperatorImage image;
  std::int64_t i{};

 private:
  int m_{-1};
  std::optional<bool> waits_;
};

TEST(HandOperator, HandsDoWhatTheBehaviourAsksFor) {
  Scene s({.start = {12, -34}, .height = 0.015});
  s.running();
  for (int m = 0; m <= 7; ++m) {
    const hand_order_t o = s.macrostep(m, false, false);
    const HandAction first = m == 1 || m == 2 ? HandAction::lead_along
                             : m == 3         ? HandAction::lead_to
                                              : HandAction::release;
    const HandAction second = m == 3 ? HandAction::lead_to : HandAction::release;
    EXPECT_EQ(o.action[0], static_cast<int>(first)) << m;
    EXPECT_EQ(o.action[1], static_cast<int>(second)) << m;
    EXPECT_EQ(o.x[0], 12);
    EXPECT_EQ(o.y[1], -34);
    EXPECT_EQ(o.height[1], 0.015);
    EXPECT_EQ(o.new_sheet[0], m == 3);  // once, when the teach-in is over
    EXPECT_EQ(o.new_sheet[1], 0);
    EXPECT_EQ(s.macrostep(m, false, false).new_sheet[0], 0);
  }
  EXPECT_EQ(s.human.progress(), 0.25);
}

TEST(HandOperator, StartsWhenTheTaskWaitsForIt) {
  Scene s;
  EXPECT_FALSE((s.macrostep(0, false, false), s.image.started));
  s.command_server.set_state(TaskState::waiting_for_start, false);
  EXPECT_TRUE((s.macrostep(0, false, false), s.image.started));
}

TEST(HandOperator, TriggersOncePerBehaviourWhenTheHandsHaveBeenStill) {
  Scene s({.steady = 10});
  s.running();
  for (int k = 0; k < 30; ++k) s.macrostep(2, false, true);
  EXPECT_EQ(s.image.trigger, 0);
  for (int k = 0; k < 9; ++k) s.macrostep(2, true, false);
  EXPECT_EQ(s.image.trigger, 0);
  s.macrostep(2, false, false);  // moved again
  for (int k = 0; k < 9; ++k) s.macrostep(2, true, false);
  EXPECT_EQ(s.image.trigger, 0);
  s.macrostep(2, true, false);
  EXPECT_EQ(s.image.trigger, 1);
  for (int k = 0; k < 50; ++k) s.macrostep(2, true, false);
  EXPECT_EQ(s.image.trigger, 1);
  for (int k = 0; k < 50; ++k) s.macrostep(3, true, false);  // both hands must be there
  EXPECT_EQ(s.image.trigger, 1);
  for (int k = 0; k < 50; ++k) s.macrostep(3, true, true);
  EXPECT_EQ(s.image.trigger, 2);
  for (const int m : {1, 4, 5, 6, 7})
    for (int k = 0; k < 50; ++k) s.macrostep(m, true, true);
  EXPECT_EQ(s.image.trigger, 2);
}

TEST(HandOperator, ATriggerIsNotLostInAPause) {
  Scene s({.steady = 5});
  s.running();
  s.macrostep(2, false, false);
  s.command_server.give(OperatorOrder::pause);
  s.macrostep(2, true, false);
  s.command_server.set_state(TaskState::paused, true);
  for (int k = 0; k < 50; ++k) s.macrostep(2, true, false);
  EXPECT_EQ(s.image.trigger, 0);
  s.command_server.give(OperatorOrder::resume);
  s.macrostep(2, true, false);
  s.running();
  s.macrostep(2, true, false);
  EXPECT_EQ(s.image.trigger, 1);
}

TEST(HandOperator, ATriggerThatTheCommandServerRefusesIsGivenAgain) {
  Scene s({.steady = 5});
  s.running(false);  // the task does not say yet that it waits
  for (int k = 0; k < 20; ++k) s.macrostep(2, true, false);
  EXPECT_EQ(s.image.trigger, 0);
  s.running(true);
  s.macrostep(2, true, false);
  EXPECT_EQ(s.image.trigger, 1);
}

TEST(HandOperator, KnowsWhetherATriggerWouldComeEarly) {
  Scene s({.gives_orders = false});
  s.running();
  s.macrostep(2, false, true);
  EXPECT_FALSE(s.human.done());
  s.macrostep(2, true, false);
  EXPECT_TRUE(s.human.done());
  s.human.inform(s.i + 1, 3);
  EXPECT_FALSE(s.human.done()) << "what was done belongs to the behaviour before";
  s.orders.take();
  s.macrostep(3, true, false);
  EXPECT_FALSE(s.human.done());
  s.macrostep(3, true, true);
  EXPECT_TRUE(s.human.done());
}

TEST(HandOperator, KnowsWhenThePenWasLedAlongWithoutFeelingThePaper) {
  Scene s({.steady = 3});
  s.running();
  s.macrostep(1, false, false);
  for (int k = 0; k < 3; ++k) {
    s.macrostep(1, true, false);
    EXPECT_FALSE(s.human.in_vain()) << "the sensor may still tell of it";
  }
  s.macrostep(1, true, false);
  EXPECT_TRUE(s.human.in_vain());
  EXPECT_FALSE(s.human.done());
  s.macrostep(2, true, false);
  EXPECT_FALSE(s.human.in_vain());
}

TEST(HandOperator, LeavesOrdersToAPersonWhenThereIsOne) {
  Scene s({.steady = 1, .gives_orders = false});
  s.command_server.set_state(TaskState::waiting_for_start, false);
  for (int k = 0; k < 20; ++k) s.macrostep(0, true, true);
  EXPECT_FALSE(s.image.started);
  s.running();
  for (int k = 0; k < 20; ++k) s.macrostep(3, true, true);
  EXPECT_EQ(s.image.trigger, 0);
}

}  // namespace
}  // namespace mrroc::drawing
