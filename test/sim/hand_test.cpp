#include "sim/hand.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/statistics.hpp"
#include "test/sim/driver.hpp"

namespace mrroc::sim {
namespace {

using Point = Eigen::Vector2d;

double distance(const Point& p, const Polyline& line) {
  double least = (p - line.front()).norm();
  for (std::size_t k = 1; k < line.size(); ++k) {
    const Point along = line[k] - line[k - 1];
    const double part = std::clamp((p - line[k - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - line[k - 1] - part * along).norm());
  }
  return least;
}

// An arm that can be led by the pen (law (28), F_d = 0), and that presses with 1 N on the paper.
class LedArm : public testing::Test {
 protected:
  void SetUp() override {
    cell_.prepare();
    for (Driver& driver : cell_.drivers)
      driver.command.x = driver.command.y = driver.command.z = c(0, 20, 0.005);
  }
  // Steps while the teacher leads, as the virtual sensor of the pen and the teach-in table would have it.
  void teach() {
    const ArmTruth& truth = cell_.world.truth(0);
    if (truth.paper_force > 1) on_paper_ = true;
    if (truth.pen_height > 6e-4) on_paper_ = false;
    cell_.drivers[0].command.z = c(on_paper_ ? 1 : 0, 20, 0.005);
  }
  int lead_to_the_end(int at_most) {
    int steps = 0;
    for (; hand_.status().phase == HandPhase::leading && steps < at_most; ++steps)
      cell_.run(1, [&] { teach(); });
    return steps;
  }

  Cell cell_;
  Hand& hand_{cell_.world.hand(0)};
  bool on_paper_{};
};

TEST_F(LedArm, LeavesInkAlongTheDrawing) {
  const std::vector<Polyline> drawing{{{-30, -20}, {-10, 10}}, {{0, 0}, {20, 0}, {20, 20}}, {{30, -10}}};
  hand_.lead_along(drawing);
  EXPECT_EQ(hand_.status().strokes, 3);
  ASSERT_LT(lead_to_the_end(20000), 20000);
  EXPECT_EQ(hand_.status().fraction, 1);

  Statistics error;
  for (const InkPoint& p : cell_.world.ink(0)) {
    ASSERT_LT(p.stroke, 3);
    error.add(distance({p.x, p.y}, drawing[static_cast<std::size_t>(p.stroke)]));
  }
  EXPECT_LT(std::hypot(error.mean(), error.deviation()), 0.5);
  EXPECT_LT(error.most(), 1.2);
  for (std::size_t k = 0; k < drawing.size(); ++k)
    for (const Point& corner : drawing[k]) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const InkPoint& p : cell_.world.ink(0))
        if (p.stroke == static_cast<int>(k)) nearest = std::min(nearest, (Point(p.x, p.y) - corner).norm());
      EXPECT_LT(nearest, 1);
    }
}

TEST_F(LedArm, PressesOnThePaperWhileDrawing) {
  hand_.lead_along({{{-40, 0}, {40, 0}}});
  Statistics force;
  int steps = 0;
  while (hand_.status().phase == HandPhase::leading && steps++ < 10000) {
    cell_.run(1, [&] { teach(); });
    if (hand_.status().fraction > 0.1 && hand_.status().on_paper) force.add(cell_.world.truth(0).paper_force);
  }
  EXPECT_NEAR(force.mean(), 1.5, 0.4);
  EXPECT_LT(force.deviation(), 0.8);
}

TEST_F(LedArm, PauseBringsItSmoothlyToRestAndResumeGoesOnWithoutAMark) {
  const Polyline line{{-40, 0}, {40, 0}};
  hand_.lead_along({line});
  while (hand_.status().fraction < 0.5) cell_.run(1, [&] { teach(); });
  hand_.pause(true);
  EXPECT_TRUE(hand_.status().paused);
  cell_.run(500, [&] { teach(); });
  const Vector3 rest = cell_.world.truth(0).T_0E.p;
  cell_.run(1000, [&] { teach(); });
  EXPECT_LT((cell_.world.truth(0).T_0E.p - rest).norm(), 5e-4);
  EXPECT_NEAR(hand_.status().fraction, 0.55, 0.1);
  hand_.pause(false);
  ASSERT_LT(lead_to_the_end(10000), 10000);
  for (const InkPoint& p : cell_.world.ink(0)) EXPECT_LT(distance({p.x, p.y}, line), 1);
}

TEST_F(LedArm, BothArmsAreLedToAPointAboveThePaperAndStay) {
  const Point start(-25, 30);
  for (int arm = 0; arm < 2; ++arm) cell_.world.hand(arm).lead_to(start, 0.010);
  cell_.run(4000);
  Statistics height;
  cell_.run(1000, [&] {
    for (int arm = 0; arm < 2; ++arm) height.add(cell_.world.truth(arm).pen_height);
  });
  for (int arm = 0; arm < 2; ++arm) {
    EXPECT_EQ(cell_.world.hand(arm).status().phase, HandPhase::done);
    const Vector3 at = PaperParameters{}.T_0P.inverse() * cell_.world.truth(arm).T_0E.p;
    EXPECT_NEAR(1e3 * at.x(), start.x(), 1);
    EXPECT_NEAR(1e3 * at.y(), start.y(), 1);
    EXPECT_TRUE(cell_.world.ink(arm).empty());
  }
  EXPECT_GT(height.least(), 0.0085);
  EXPECT_LT(height.most(), 0.0115);
}

TEST_F(LedArm, IsLiftedBeforeItIsLedAwayFromThePaper) {
  hand_.lead_along({{{-40, 0}, {40, 0}}});
  while (hand_.status().fraction < 0.5) cell_.run(1, [&] { teach(); });
  hand_.lead_to({0, 40}, 0.010);
  ASSERT_LT(lead_to_the_end(5000), 5000);
  for (const InkPoint& p : cell_.world.ink(0)) EXPECT_LT(std::abs(p.y), 0.1);
}

TEST_F(LedArm, IsLeftAloneAfterRelease) {
  hand_.lead_to({10, 10}, 0.01);
  cell_.run(1500);
  hand_.release();
  EXPECT_EQ(hand_.status().phase, HandPhase::idle);
  cell_.run(200);
  EXPECT_EQ(cell_.world.truth(0).hand_force, Vector3(0, 0, 0));
}

TEST(Hand, AnEmptyDrawingIsDoneAtOnce) {
  Hand hand({}, {}, 1);
  hand.lead_along({{}, {}});
  EXPECT_EQ(hand.status().phase, HandPhase::done);
  EXPECT_EQ(hand.status().strokes, 0);
}

TEST(Hand, TremblesWithTheGivenAmplitude) {
  const PaperParameters paper;
  HandParameters p;
  p.damping = p.drag = p.inertia = 0;
  Hand hand(p, paper, 1);
  hand.lead_to({0, 0}, 0.02);
  const Vector3 tip = paper.T_0P * Vector3(0, 0, 0.02);
  Statistics force;
  for (int k = 0; k < 60000; ++k) {
    const Vector3 f = hand.step(1e-3, tip, Vector3::Zero(), false);
    if (k > 5000) force.add(f.x());
  }
  EXPECT_NEAR(force.deviation(), p.stiffness * p.tremor, 0.1 * p.stiffness * p.tremor);
}

}  // namespace
}  // namespace mrroc::sim
