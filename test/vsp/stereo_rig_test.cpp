// A pair of cameras as one instrument: points from rectified places whatever the lenses and directions, and pairs that are
// refused.
#include "vsp/odometry/stereo_rig.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/fault.hpp"
#include "test/vsp/plane_camera.hpp"
#include "test/vsp/stereo_room.hpp"

namespace mrroc::vsp {
namespace {

RigCamera left() { return {test::stereo_camera(), test::stereo_place(0.06)}; }
RigCamera right() { return {test::stereo_camera(), test::stereo_place(-0.06)}; }

RigCamera turned(RigCamera camera, const Vector3& aa) {
  camera.T_BC.R *= rotation_from_angle_axis(aa);
  return camera;
}

std::string refusal(const RigCamera& a, const RigCamera& b) {
  try {
    const StereoRig rig(a, b);
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
    return e.what();
  }
  return "";
}

/// Points of a grid before the cameras are found again from where both see them.
void expect_points(const RigCamera& a, const RigCamera& b) {
  const StereoRig rig(a, b);
  for (const double x : {1.0, 3.0, 8.0})
    for (const double y : {-0.3, 0.0, 0.25})
      for (const double z : {0.0, 0.4}) {
        const Vector3 point(x, x * y, z);  // on B
        const auto seen = [&](const RigCamera& c) { return project(c.model, c.T_BC.inverse() * point); };
        const Vector2 from_left = rig.rectified_left({seen(a)}).at(0);
        const Vector2 from_right = rig.rectified_right({seen(b)}).at(0);
        EXPECT_NEAR(from_left.y(), from_right.y(), 1e-3) << "rows";
        EXPECT_LT((rig.T_BS() * rig.point(from_left, from_right) - point).norm(), 1e-4 * x * x);
      }
}

TEST(StereoRig, FindsPointsFromWhereBothCamerasSeeThem) {
  EXPECT_NEAR(StereoRig(left(), right()).baseline(), 0.12, 1e-12);
  expect_points(left(), right());
}

TEST(StereoRig, FreesPlacesOfLensesAndOfDirectionsThatDiffer) {
  RigCamera a = turned(left(), {0.02, 0.05, -0.03});
  RigCamera b = turned(right(), {-0.01, -0.04, 0.02});
  a.model.distortion = test::web_camera().distortion;
  b.model.fx = 430;
  b.model.cx = 310;
  b.T_BC.p += Vector3(0.004, 0, -0.003);
  expect_points(a, b);
}

TEST(StereoRig, RefusesWhatIsNoPairAndSaysWhy) {
  EXPECT_EQ(refusal(left(), right()), "");
  EXPECT_NE(refusal(right(), left()).find("left of the left one"), std::string::npos);
  EXPECT_NE(refusal(left(), left()).find("at least 0.01 m apart, they are 0.0000 m"), std::string::npos);
  RigCamera other = right();
  other.model.width = 320;
  EXPECT_NE(refusal(left(), other).find("left 640 x 480, right 320 x 480"), std::string::npos);
  EXPECT_NE(refusal(left(), turned(right(), {0, 0.4, 0})).find("look the same way"), std::string::npos);
  other = right();
  other.model.fx = 0;
  EXPECT_NE(refusal(left(), other).find("improper model"), std::string::npos);
  other = right();
  other.T_BC.p.x() = std::nan("");
  EXPECT_NE(refusal(left(), other), "");
}

}  // namespace
}  // namespace mrroc::vsp
