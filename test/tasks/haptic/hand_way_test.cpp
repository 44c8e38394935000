#include "tasks/haptic/hand_way.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/fault.hpp"

namespace mrroc::haptic {
namespace {

Scene scene() {
  Scene s;
  s.height = 0.1;
  s.side = 0.042;
  s.top = 0.07;
  s.depth = 0.06;
  s.compliance = 0.00125;
  return s;
}

TEST(HapticHandWay, LeadsTheSlaveIntoTheSideAndTheTopOfThePlateInAnyScale) {
  for (const double scale : {0.6, 1.0, 2.0}) {
    Law law;
    law.motion_scale = scale;
    const auto way = hand_way(scene(), law, {});
    double farthest = 0, lowest = 1;
    for (const mp::WayPoint& point : way) {
      const Vector3 slave = Vector3(0, 0, 0.1) + scale * (point.p - Vector3(0, 0, 0.1));
      if (slave.z() < 0.06) farthest = std::max(farthest, slave.y());
      if (slave.y() > 0.06) lowest = std::min(lowest, slave.z());
    }
    EXPECT_GT(farthest, scene().side + 0.01) << scale;
    EXPECT_LT(lowest, scene().top - 0.01) << scale;
    EXPECT_LT((way.front().p - way.back().p).norm(), 1e-9);
  }
}

TEST(HapticHandWay, HasNoStepsFasterThanTheHand) {
  const OperatorPlan plan;
  const auto way = hand_way(scene(), {}, plan);
  for (std::size_t n = 1; n < way.size(); ++n) {
    ASSERT_GT(way[n].t, way[n - 1].t);
    ASSERT_LE((way[n].p - way[n - 1].p).norm(), 1.3 * plan.speed * (way[n].t - way[n - 1].t)) << way[n].t;
  }
}

TEST(HapticHandWay, RefusesToLeadTheMasterIntoItsTable) {
  Law law;
  law.motion_scale = 0.5;
  Scene low = scene();
  low.top = 0.03;
  EXPECT_THROW(static_cast<void>(hand_way(low, law, {})), FaultError);
}

}  // namespace
}  // namespace mrroc::haptic
