// The cube in pictures: every sticker where the cube has it, with its colour, also while a layer turns.
#include "sim/camera/cube_view.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "base/cube/face_view.hpp"
#include "base/cube/facelets.hpp"
#include "base/cube/move.hpp"
#include "sim/camera/renderer.hpp"
#include "tasks/rubik/cell/cube_camera.hpp"
#include "tasks/rubik/cell/layout.hpp"
#include "test/sim/camera/scenes.hpp"

namespace mrroc::sim {
namespace {

using cube::Face;

camera::Scene scene_of(const CubeTruth& truth) {
  camera::Scene scene;
  scene.light.lamp = {0, 0, 0};
  scene.light.ambient = {1, 1, 1};
  add_cube(scene.bodies, truth);
  return scene;
}

/// Number of the colour whose tint a pixel has, however bright the light is there.
int colour_at(const Image& picture, const Vector2& p) {
  const auto channel = [&](int c) -> double {
    return picture.view().at(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())), c);
  };
  const auto seen = tint({channel(2), channel(1), channel(0)});
  const StickerLook look;
  int best = -1;
  double least = 1e9;
  for (int k = 0; k < kStickerColours; ++k) {
    const auto& c = look.colours[static_cast<std::size_t>(k)];
    const auto own = tint({255 * c[0], 255 * c[1], 255 * c[2]});
    const double distance = std::hypot(seen[0] - own[0], seen[1] - own[1]);
    if (distance < least) least = distance, best = k;
  }
  return best;
}

class CubeView : public testing::Test {
 protected:
  CubeView() : renderer_(camera_, in_colour()) {}
  static camera::RenderProfile in_colour() {
    camera::RenderProfile p = test::clean(camera::fast_profile());
    p.channels = 3;
    return p;
  }
  Image look(const CubeTruth& truth, Face face) {
    const Matrix3 R = cube::facelet_frame(face);
    eye_ = looking_at(R.col(2) * 0.3, Vector3::Zero(), R.col(1));
    return renderer_.render(scene_of(truth), eye_, 0);
  }
  int seen(const Image& picture, const Vector3& in_cube) {
    return colour_at(picture, project(camera_, eye_.inverse() * in_cube));
  }

  CameraModel camera_;
  Pose eye_;
  camera::Renderer renderer_;
};

TEST_F(CubeView, ShowsTheStickersOfItsState) {
  std::mt19937_64 random(2);
  CubeTruth truth;
  truth.state = cube::random_cube(random);
  const std::string facelets = cube::to_facelets(truth.state);
  for (int f = 0; f < cube::kFaces; ++f) {
    const Matrix3 R = cube::facelet_frame(static_cast<Face>(f));
    const Image picture = look(truth, static_cast<Face>(f));
    for (int k = 0; k < kStickers; ++k) {
      const Vector3 place = R * (kCubeFace.middle(k) + Vector3(0, 0, kCubeFace.edge / 2));
      EXPECT_EQ("URFDLB"[seen(picture, place)], facelets[static_cast<std::size_t>(kStickers * f + k)])
          << f << k;
    }
  }
}

TEST_F(CubeView, ShowsALayerThatTurns) {
  const double angle = 0.5;
  for (const int side : {0, 1}) {
    CubeTruth truth;
    truth.axis = 1;  // B and F
    truth.angle[static_cast<std::size_t>(side)] = angle;
    const Face face = side == 0 ? Face::B : Face::F;
    const Matrix3 R = cube::facelet_frame(face);
    const Vector3 out = R.col(2) * kCubeFace.edge / 2;
    const Image picture = look(truth, face);
    // A corner's sticker, counterclockwise seen from outside; where it was nothing of the cube is left.
    const Vector3 corner = R * Vector3(0.026, 0.026, 0);
    const Vector3 turned = rotation_from_angle_axis(angle * R.col(2)) * corner;
    EXPECT_EQ("URFDLB"[seen(picture, turned + out)], letter(face));
    const Vector3 other_way = rotation_from_angle_axis(-angle * R.col(2)) * corner;
    const Vector2 p = project(camera_, eye_.inverse() * Vector3(other_way + out));
    EXPECT_NEAR(picture.view().at(static_cast<int>(p.x()), static_cast<int>(p.y()), 0), 0.70 * 255, 3)
        << "the background";
  }
}

TEST(CubeCamera, LooksStraightAtTheFaceWhereFacesAreShown) {
  const CameraSetup camera = rubik::cube_camera();
  const rubik::Viewing viewing = rubik::viewing_place();
  const Pose T_CG = camera.place.inverse() * viewing.T_UG;
  EXPECT_NEAR((T_CG.p - Vector3(0, 0, viewing.distance)).norm(), 0, 1e-12);
  EXPECT_NEAR(T_CG.R(2, 2), -1, 1e-12);
  // The whole face is in the picture, large enough to be read.
  for (const int k : {0, 2, 6, 8}) {
    const Vector2 p = project(camera.model, T_CG * kCubeFace.middle(k));
    EXPECT_GT(std::abs(p.x() - camera.model.cx), 40);
    EXPECT_LT(std::abs(p.x() - camera.model.cx), camera.model.width / 4.);
    EXPECT_LT(std::abs(p.y() - camera.model.cy), camera.model.height / 4.);
  }
}

}  // namespace
}  // namespace mrroc::sim
