#include "tasks/rex_drive/ontology.hpp"

#include <gtest/gtest.h>

namespace mrroc::rex_drive {
namespace {

using X = Ontology::X;

std::vector<Plan> plans(int n) {
  std::vector<Plan> list;
  for (int k = 1; k <= n; ++k)
    list.push_back({.number = k, .n = 2, .point = {{{0.5, 0}, {1, 0}}}, .speed = 0.5});
  return list;
}

/// a_1 and a_3 as a_2 sees them: a_1 takes a plan, executes it for a while, acknowledges it, and stands at last.
class Agents {
 public:
  void dispatch(const Motion<Ontology>& motion, const Ontology::Y& y) {
    if (sent.empty() || sent.back() != y.T[kLocomotionAgent].plan.number)
      sent.push_back(y.T[kLocomotionAgent].plan.number);
    plan_ = y.T[kLocomotionAgent].plan.number;
    if (behaviours.empty() || behaviours.back() != motion.m) behaviours.push_back(motion.m);
    variant = y.T[kLocomotionAgent].variant;
  }
  Outcome wait() { return ++i_ < kLongest ? Outcome::terminated : Outcome::aborted; }
  void read(X& x) {
    constexpr std::int64_t kTakes = 3, kExecutes = 50;
    x.i = i_;
    x.T.h.started = true;
    x.t.paused = paused;
    for (Report& r : x.T.agent) r.ready = true;
    Report& r = x.T.agent[kLocomotionAgent];
    if (plan_ > taken_ && i_ - acked_in_ >= kTakes) {
      taken_ = plan_;
      begun_ = i_;
      r.m = 2;
      r.event = 0;
    }
    if (r.m == 2 && i_ - begun_ >= kExecutes && (taken_ != stuck)) {
      r.m = 1;
      r.event = static_cast<int>(taken_);
      acked_in_ = i_;
      acks.push_back(i_);
    }
    r.sensor = (r.m == 1 && i_ - acked_in_ > 40 ? kStands : 0) + (i_ >= lost_from ? kPositionLost : 0);
  }

  std::vector<std::int64_t> sent;     ///< numbers of plans, each once in a row
  std::vector<std::int64_t> acks;     ///< macrosteps
  std::vector<int> behaviours;        ///< of a_2
  int variant{};                      ///< of the last order
  bool paused{};                      ///< the operator has a pause
  std::int64_t stuck{};               ///< number of a plan that never ends
  std::int64_t lost_from{1'000'000};  ///< macrostep from which on a_1 waits for its position

 private:
  static constexpr std::int64_t kLongest = 5000;
  std::int64_t i_{1}, plan_{}, taken_{}, begun_{}, acked_in_{};
};

Outcome execute(const std::vector<Plan>& list, Agents& agents, X& x) {
  agents.read(x);
  return execute_plans(list, x, agents);
}

TEST(Ontology, SendsEachPlanAfterTheAckOfTheOneBeforeAndComesToRest) {
  Agents agents;
  X x;
  x.c.k.think = 10;
  EXPECT_EQ(execute(plans(3), agents, x), Outcome::terminated);
  EXPECT_EQ(agents.sent, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(agents.behaviours, (std::vector<int>{1, 2, 1, 2, 1, 2, 3}));
  ASSERT_EQ(agents.acks.size(), 3U);
}

TEST(Ontology, ThinksBetweenPlans) {
  std::array<std::int64_t, 2> gap{};
  for (std::size_t k = 0; k < 2; ++k) {
    Agents agents;
    X x;
    x.c.k.think = k == 0 ? 0 : 30;
    EXPECT_EQ(execute(plans(2), agents, x), Outcome::terminated);
    gap[k] = agents.acks.at(1) - agents.acks.at(0);
  }
  EXPECT_NEAR(static_cast<double>(gap[1] - gap[0]), 30, 4);
}

TEST(Ontology, PassesThePauseOn) {
  X x;
  x.t.paused = true;
  EXPECT_EQ(kAwaitAck.f_cT(x)[kLocomotionAgent].variant, kPaused);
  x.t.paused = false;
  EXPECT_EQ(kAwaitAck.f_cT(x)[kLocomotionAgent].variant, 0);
}

TEST(Ontology, GivesUpWhenThePositionIsLostForTooLong) {
  Agents agents;
  agents.stuck = 1;
  agents.lost_from = 100;
  X x;
  x.c.k.timeout = 200;
  EXPECT_EQ(execute(plans(2), agents, x), Outcome::terminated);
  EXPECT_TRUE(in_vain(x));
  EXPECT_NEAR(static_cast<double>(x.i), 300, 5);
}

TEST(Ontology, TellsThePointUnderWay) {
  Report r;
  r.sensor = 7 * kPointUnit + kMapSeen + kStands;
  EXPECT_EQ(point_of(r), 7);
}

}  // namespace
}  // namespace mrroc::rex_drive
