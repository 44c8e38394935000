// The camera to which faces are shown sees all of them, in every reading.
#include "tasks/rubik/cell/cube_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/cube/cube_face.hpp"
#include "tasks/rubik/cell/layout.hpp"

namespace mrroc::rubik {
namespace {

const CameraSetup& camera() {
  static const CameraSetup setup = cube_camera();
  return setup;
}

/// @return where a corner of the face is seen [pixel]
Vector2 seen(const Viewing& viewing, double x, double y) {
  const double half = kCubeFace.edge / 2;
  return project(camera().model, camera().place.inverse() * viewing.T_UG * Vector3(half * x, half * y, 0));
}

TEST(CubeCamera, SeesTheWholeFaceWithRoomAroundItInEveryReading) {
  for (int reading = 0; reading < 4; ++reading)
    for (const double x : {-1., 1.})
      for (const double y : {-1., 1.}) {
        const Vector2 p = seen(viewing_place(reading), x, y);
        EXPECT_GT(p.x(), 0.1 * camera().model.width);
        EXPECT_LT(p.x(), 0.9 * camera().model.width);
        EXPECT_GT(p.y(), 0.1 * camera().model.height);
        EXPECT_LT(p.y(), 0.9 * camera().model.height);
      }
}

TEST(CubeCamera, ShowsAFaceThatIsSquareToItAsALargeSquareInTheMiddle) {
  const Viewing viewing = viewing_place();
  const Vector2 middle = seen(viewing, 0, 0);
  EXPECT_NEAR(middle.x(), camera().model.cx, 1e-9);
  EXPECT_NEAR(middle.y(), camera().model.cy, 1e-9);
  const double edge = (seen(viewing, 1, 1) - seen(viewing, -1, 1)).norm();
  EXPECT_NEAR((seen(viewing, -1, -1) - seen(viewing, -1, 1)).norm(), edge, 1e-9) << "pixels are square";
  EXPECT_GT(edge, camera().model.height / 4.) << "stickers are large enough to be read";
  EXPECT_LT(edge, camera().model.height / 2.);
}

TEST(CubeCamera, IsTheOneThatTheHeaderDescribes) {
  constexpr double kStep = 0.002;  // of the drivers [s]
  EXPECT_EQ(camera().key, "cube");
  EXPECT_EQ(camera().mount, CameraMount::world);
  EXPECT_EQ(camera().model.width, 640);
  EXPECT_EQ(camera().model.height, 480);
  for (const double k : camera().model.distortion) EXPECT_EQ(k, 0);
  EXPECT_NEAR(static_cast<double>(camera().period) * kStep, 0.2, 1e-12);
}

}  // namespace
}  // namespace mrroc::rubik
