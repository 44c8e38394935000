// Before a grip both hands are weighed: that which has the cube with it, the other one without.
#include <gtest/gtest.h>

#include <array>
#include <tuple>

#include "tasks/rubik/program.hpp"
#include "test/tasks/rubik/two_arms.hpp"

namespace mrroc::rubik {
namespace {

TEST(RubikWeighing, TheHandThatHasTheCubeAccordingToItsStepIsWeighedWithItAndTheOtherOneWithoutIt) {
  TwoArms arms;
  Coordinator::X x;
  ExecutionLog execution_log;
  for (const Hand hand : kHands) {
    x.c.k.load[index(hand)][0].weight = 1 + static_cast<double>(index(hand));
    x.c.k.load[index(hand)][1].weight = 11 + static_cast<double>(index(hand));
  }
  Program<TwoArms> program(x, arms, execution_log);
  ASSERT_EQ(program.wait_for_start(), Outcome::terminated);
  for (const Hand holder : {Hand::track, Hand::postument, Hand::track}) {
    Step step;  // without free motions
    step.before_grasp.hand = step.leaves = step.retreat.hand = holder;
    step.after_grasp.hand = step.comes = other(holder);
    std::ignore = program.execute(step);  // the hands are weighed at its begin, whatever becomes of it
    std::array<double, kArms> expected{1, 2};
    expected[index(holder)] += 10;
    ASSERT_FALSE(arms.weights.empty());
    EXPECT_EQ(arms.weights.back(), expected);
  }
}

}  // namespace
}  // namespace mrroc::rubik
