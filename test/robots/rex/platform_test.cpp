// Rex as its driver sees it.
#include <gtest/gtest.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <array>
#include <stdexcept>
#include <string>
#include <tuple>

#include "robots/rex/parameters.hpp"
#include "robots/rex/platform_type.hpp"
#include "robots/rex/rex.hpp"

namespace mrroc::rex {
namespace {

TEST(Rex, HasTheTrackersThatItNames) {
  ASSERT_FALSE(platform().trackers().empty());
  EXPECT_EQ(platform().trackers().front(), "nmpc");
  for (const std::string_view kind : platform().trackers()) EXPECT_NE(platform().tracker(kind), nullptr);
  for (const std::string_view kind : platform().estimators()) EXPECT_NE(platform().estimator(kind), nullptr);
}

TEST(Rex, AnAlgorithmThatItHasNotIsToldWithThoseThatItHas) {
  try {
    std::ignore = platform().tracker("pid");
    FAIL() << "there is a tracker pid";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "the platform rex has no tracker 'pid'; it has nmpc, kinematic");
  }
  EXPECT_THROW(std::ignore = platform().estimator(""), std::invalid_argument);
}

TEST(Rex, CanDoWhatAFragmentMayAskFor) {
  const edp::PlatformProperties& p = platform().properties();
  EXPECT_LT((p.max_speed + p.max_turn_rate * p.half_track) / p.wheel_radius, p.max_wheel_speed);
  EXPECT_GT(p.max_torque, 0);
  EXPECT_GT(p.brake, 0);
}

TEST(Rex, LooksAsItsKernelsKnowIt) {
  const auto model = urdf::parseURDF(std::string(type().urdf));
  ASSERT_NE(model, nullptr);
  const std::array names{"front_left", "front_right", "rear_left", "rear_right"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto joint = model->getJoint(names[i]);
    ASSERT_NE(joint, nullptr) << names[i];
    EXPECT_EQ(joint->type, urdf::Joint::CONTINUOUS);
    EXPECT_EQ(joint->axis.y, 1);  // forward is positive
    EXPECT_EQ(joint->parent_to_joint_origin_transform.position.x, kWheelX[i]);
    EXPECT_EQ(joint->parent_to_joint_origin_transform.position.y, kWheelY[i]);
    const auto* wheel =
        dynamic_cast<urdf::Cylinder*>(model->getLink(names[i])->visual_array[0]->geometry.get());
    ASSERT_NE(wheel, nullptr);
    EXPECT_EQ(wheel->radius, kWheelRadius);
  }
  EXPECT_EQ(model->getJoint("height")->parent_to_joint_origin_transform.position.z, kWheelRadius);
}

}  // namespace
}  // namespace mrroc::rex
