// What the tool's camera takes for the place of the tool when it is not where it is believed.
#include "tasks/visual_servo/cell/tool_camera.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/screw.hpp"
#include "test/tasks/visual_servo/built_in.hpp"

namespace mrroc::visual_servo {
namespace {

double length_of_error(const std::vector<std::string>& settings) {
  return log_screw(tool_camera_error(built_in(settings))).vector().norm();
}

TEST(ToolCamera, SeesTheObjectFromWhereItTrulyIs) {
  // It believes to be at [0.08, 0, -0.16], along the axes of E.
  const Pose ahead = tool_camera_error(built_in({"sim.cameras.eih.place_error.x=0.003"}));
  EXPECT_NEAR((ahead.p - Vector3(-0.003, 0, 0)).norm(), 0, 1e-12);
  const Pose turned = tool_camera_error(built_in({"sim.cameras.eih.place_error.ay=0.01"}));
  const Vector3 at_itself = turned * Vector3(0.08, 0, -0.16);
  EXPECT_NEAR((at_itself - Vector3(0.08, 0, -0.16)).norm(), 0, 1e-12) << "about itself";
  EXPECT_NEAR(angle_axis_from_rotation(turned.R).y(), -0.01, 1e-12);
}

TEST(ToolCamera, ErrsNoLongerWhenItIsBelievedWhereItTrulyIs) {
  EXPECT_NEAR(length_of_error({"sim.cameras.eih.place_error.x=0.003",
                               "cell.cameras.eih.pose=[0.083, 0, -0.16, 0, 0, 0]"}),
              0, 1e-12);
}

TEST(ToolCamera, KnowsTheErrorWhenItIsWhereItIsBelieved) {
  EXPECT_NEAR(length_of_error({}), 0, 1e-12);
  EXPECT_NEAR(length_of_error({"sim.cameras.sac.place_error.x=0.003"}), 0, 1e-12) << "the other one";
  EXPECT_NEAR(length_of_error({"cameras.order=[\"sac\"]", "sim.cameras.eih.place_error.x=0.003"}), 0, 1e-12)
      << "it is not used";
}

}  // namespace
}  // namespace mrroc::visual_servo
