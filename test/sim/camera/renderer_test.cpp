// Measurements on rendered pictures.
#include "sim/camera/renderer.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <numbers>
#include <thread>

#include "base/fault.hpp"
#include "base/statistics.hpp"
#include "test/sim/camera/scenes.hpp"

namespace mrroc::camera {
namespace {

using test::bent_camera;
using test::board_on_table;
using test::clean;
using test::hash_of;

/// Where the four squares around an inner corner meet. Along a line across an edge the share of white tells where the
/// edge is; the corner is where the edges of both directions, seen on both sides of it, cross.
class CornerFinder {
 public:
  explicit CornerFinder(const ImageView& image) : image_(image) {}

  /// @param at  expected place @param x, y  steps to points on edges on one side of it [pixel]
  [[nodiscard]] Vector2 find(const Vector2& at, const Vector2& x, const Vector2& y) const {
    Vector2 corner = at;
    for (int round = 0; round < 3; ++round) {
      const double a = (shift(corner + x, y) + shift(corner - x, y)) / 2;
      const double b = (shift(corner + y, x) + shift(corner - y, x)) / 2;
      corner += a * y.normalized() + b * x.normalized();
    }
    return corner;
  }

 private:
  [[nodiscard]] double grey(const Vector2& p) const {
    const int u = static_cast<int>(std::floor(p.x()));
    const int v = static_cast<int>(std::floor(p.y()));
    const double du = p.x() - u;
    const double dv = p.y() - v;
    return (1 - dv) * ((1 - du) * image_.at(u, v) + du * image_.at(u + 1, v)) +
           dv * ((1 - du) * image_.at(u, v + 1) + du * image_.at(u + 1, v + 1));
  }

  /// @return how far along `across` the edge at p really is [pixel]
  [[nodiscard]] double shift(const Vector2& p, const Vector2& across) const {
    const Vector2 n = across.normalized();
    const double reach = 0.8 * across.norm();
    const double first = grey(p - reach * n);
    const double last = grey(p + reach * n);
    double sum = 0;
    constexpr int kSamples = 200;
    for (int k = 0; k < kSamples; ++k)
      sum += (grey(p + reach * (2 * (k + 0.5) / kSamples - 1) * n) - first) / (last - first);
    return reach * (1 - 2 * sum / kSamples);
  }

  ImageView image_;
};

double corner_error_rms(const CameraModel& camera, const RenderProfile& profile) {
  const BoardSize board;
  Renderer renderer(camera, profile);
  const Scene scene = board_on_table(board);
  Statistics squares;
  for (const Vector3& eye : {Vector3(0, -0.001, 0.5), Vector3(0.1, -0.35, 0.45), Vector3(-0.3, 0.1, 0.6)}) {
    const Pose T_UC = looking_at(eye, {0.01, 0, 0}, {0, 1, 0});
    const Image image = renderer.render(scene, T_UC, 0);
    const Pose T_CG = T_UC.inverse() * Pose{Matrix3::Identity(), {0, 0, 0.005}};
    const auto seen = [&](const Vector3& p) { return project(camera, T_CG * p); };
    for (const Vector3& corner : test::corners_of(board)) {
      const Vector2 expected = seen(corner);
      const Vector2 x = seen(corner + Vector3(0.4 * board.square, 0, 0)) - expected;
      const Vector2 y = seen(corner + Vector3(0, 0.4 * board.square, 0)) - expected;
      const double error = (CornerFinder(image.view()).find(expected, x, y) - expected).norm();
      squares.add(error * error);
    }
  }
  return std::sqrt(squares.mean());
}

TEST(Renderer, ShowsCornersWhereThePinholeModelHasThem) {
  EXPECT_LT(corner_error_rms(CameraModel{}, clean()), 0.05);
}

TEST(Renderer, ShowsCornersWhereTheLensHasThem) { EXPECT_LT(corner_error_rms(bent_camera(), clean()), 0.05); }

TEST(Renderer, KeepsCornersInTheirPlacesWhenItIsFast) {
  EXPECT_LT(corner_error_rms(bent_camera(), clean(fast_profile())), 0.05);
}

TEST(Renderer, DrawsEveryPartOfABentPicture) {
  // Whatever part of the wide picture were missing would be of another colour.
  Scene scene;
  scene.background = {0.5, 0.5, 0.5};
  const Image image = Renderer(bent_camera(), clean()).render(scene, Pose{}, 0);
  for (const std::uint8_t grey : image.data) ASSERT_NEAR(grey, 127, 1);
}

TEST(Renderer, MakesTheSameBytesInAnyThreadAndOrder) {
  const Scene scene = board_on_table();
  const Pose T_UC = looking_at({0.2, -0.4, 0.5}, {0, 0, 0}, {0, 0, 1});
  const auto draw = [&](const std::vector<std::int64_t>& frames) {
    Renderer renderer(bent_camera(), exact_profile());
    std::map<std::int64_t, std::uint64_t> hashes;
    for (const std::int64_t frame : frames) hashes[frame] = hash_of(renderer.render(scene, T_UC, frame));
    return hashes;
  };
  const auto first = draw({0, 1, 2});
  EXPECT_NE(first.at(0), first.at(1)) << "the noise changes";
  std::array<std::map<std::int64_t, std::uint64_t>, 2> other;
  {
    const std::jthread one([&] { other[0] = draw({2, 1, 0}); });
    const std::jthread two([&] { other[1] = draw({1, 0, 2}); });
  }
  EXPECT_EQ(other[0], first);
  EXPECT_EQ(other[1], first);
}

TEST(Renderer, HasNoiseOfTheGivenSizeThatGrowsWithTheLight) {
  const auto noise_at = [](double brightness) {
    Scene scene;
    scene.background = {brightness, brightness, brightness};
    RenderProfile profile;
    profile.noise = 4;
    Renderer renderer(CameraModel{}, profile);
    RenderProfile without = profile;
    without.noise = 0;
    const Image still = Renderer(CameraModel{}, without).render(scene, Pose{}, 0);
    const Image a = renderer.render(scene, Pose{}, 7);
    const Image b = renderer.render(scene, Pose{}, 8);
    Statistics deviation;
    double product = 0;
    for (std::size_t k = 0; k < a.data.size(); ++k) {
      deviation.add(a.data[k] - still.data[k]);
      product += (a.data[k] - still.data[k]) * (b.data[k] - still.data[k]);
    }
    EXPECT_NEAR(deviation.mean(), 0, 0.05);
    EXPECT_NEAR(product / static_cast<double>(a.data.size()), 0, 0.05) << "two frames have nothing in common";
    return deviation.deviation();
  };
  EXPECT_NEAR(noise_at(0.5), 4, 0.1);
  EXPECT_NEAR(noise_at(0.2), 4 * std::sqrt(0.4 + 0.6 * 0.4), 0.1);
  EXPECT_NEAR(noise_at(0.8), 4 * std::sqrt(0.4 + 0.6 * 1.6), 0.1);
}

class OneBody : public ::testing::Test {
 protected:
  /// A camera 2 m above the table; x to the right, y up.
  static Image look(const Scene& scene, RenderProfile profile = clean()) {
    return Renderer(CameraModel{}, profile).render(scene, looking_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0}), 0);
  }
  static std::uint8_t grey(const Image& image, double x, double y, double z = 0) {
    const Vector2 p = project(CameraModel{}, {x, -y, 2 - z});
    return image.view().at(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
  }
  OneBody() {
    scene_.bodies.push_back(test::table());
    scene_.light.direction = {1, 0, 1};
    block_.size = {0.1, 0.2, 0.04};
    block_.T_UB.p = {0, 0, 0.3};
    block_.colour = {0.1, 0.1, 0.1};
    block_.shine = 0;
  }
  Scene scene_;
  Body block_;
};

TEST_F(OneBody, HidesWhatIsBehindItAndNothingElse) {
  const Image without = look(scene_, clean(fast_profile()));
  scene_.bodies.push_back(block_);
  const Image with = look(scene_, clean(fast_profile()));
  const auto covered = [&](double x, double y) { return grey(with, x, y) != grey(without, x, y); };
  const double grow = 2 / (2 - 0.32);  // of its upper side, seen on the table
  EXPECT_TRUE(covered(0.049 * grow, 0.099 * grow));
  EXPECT_FALSE(covered(0.052 * grow, 0));
  EXPECT_FALSE(covered(0, 0.102 * grow));
  block_.T_UB.p.z() = -0.5;  // under the table
  scene_.bodies.back() = block_;
  EXPECT_EQ(hash_of(look(scene_, clean(fast_profile()))), hash_of(without));
}

TEST_F(OneBody, CastsItsShadowAwayFromTheLamp) {
  const Image without = look(scene_);
  scene_.bodies.push_back(block_);
  const Image with = look(scene_);
  // The lamp stands at 45 degrees on the side of +x: the shadow of what is 0.3 m high lies 0.3 m towards -x.
  EXPECT_LT(grey(with, -0.3, 0), 0.7 * grey(without, -0.3, 0));
  EXPECT_LT(grey(with, -0.3, 0.09), 0.7 * grey(without, -0.3, 0.09));
  for (const double x : {0.3, -0.4, -0.2}) EXPECT_NEAR(grey(with, x, 0), grey(without, x, 0), 1) << x;
  EXPECT_NEAR(grey(with, -0.3, 0.12), grey(without, -0.3, 0.12), 1);
  block_.casts_shadow = false;
  scene_.bodies.back() = block_;
  EXPECT_NEAR(grey(look(scene_), -0.3, 0), grey(without, -0.3, 0), 1);
}

TEST_F(OneBody, LeavesNoShadowOnLitSurfaces) {
  // Each of these is lit everywhere: the map of shadows is coarser than the picture.
  for (const Shape shape : {Shape::box, Shape::cylinder}) {
    Scene scene;
    scene.bodies.push_back(test::table());
    scene.bodies[0].shape = shape;
    scene.light.direction = {0.3, 0.4, 1};
    RenderProfile without = clean();
    without.shadow_size = 0;
    const Image with_map = look(scene);
    const Image plain = look(scene, without);
    for (std::size_t k = 0; k < plain.data.size(); ++k) ASSERT_NEAR(with_map.data[k], plain.data[k], 1);
  }
}

TEST_F(OneBody, ObeysTheLight) {
  const int plain = grey(look(scene_), 0.2, 0.2);
  scene_.light.exposure = 0.5;
  EXPECT_NEAR(grey(look(scene_), 0.2, 0.2), 0.5 * plain, 1);
  scene_.light.exposure = 10;
  EXPECT_EQ(grey(look(scene_), 0.2, 0.2), 255);
  scene_.light = {};
  scene_.light.lamp = {0.6, 0, 0};
  scene_.light.ambient = {0, 0, 0};
  RenderProfile colour = clean();
  colour.channels = 3;
  const Image red = look(scene_, colour);
  EXPECT_EQ(red.view().at(400, 200, 0), 0);
  EXPECT_EQ(red.view().at(400, 200, 1), 0);
  EXPECT_GT(red.view().at(400, 200, 2), 40);
}

TEST_F(OneBody, IsBlurredByItsMotion) {
  block_.T_UB.p.z() = 0.021;
  scene_.bodies.push_back(block_);
  std::vector<Instant> exposure;
  for (int k = 0; k < 5; ++k) {
    Scene moved = scene_;
    moved.bodies[1].T_UB.p.x() = 0.02 * (k - 2);
    exposure.push_back({moved, looking_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0})});
  }
  Renderer renderer(CameraModel{}, clean(fast_profile()));
  const Image still = renderer.render(std::span(exposure).subspan(2, 1), 0);
  const Image moving = renderer.render(exposure, 0);
  EXPECT_EQ(grey(moving, 0, 0, 0.04), grey(still, 0, 0, 0.04)) << "covered all the time";
  const int dark = grey(still, 0.0, 0, 0.04);
  const int light = grey(still, 0.2, 0, 0.04);
  EXPECT_NEAR(grey(moving, 0.06, 0, 0.04), dark + (light - dark) * 3 / 5.0, 2)
      << "covered in two instants of five";
  EXPECT_EQ(grey(moving, 0.2, 0, 0.04), light);
}

TEST_F(OneBody, IsBlurredByTheLens) {
  scene_.bodies.push_back(block_);
  const auto steepest = [&](double defocus) {
    RenderProfile p = clean();
    p.defocus = defocus;
    p.shadow_size = 0;
    const Image image = look(scene_, p);
    double most = 0;
    for (int u = 321; u < 380; ++u)
      most = std::max<double>(most, std::abs(image.view().at(u, 240) - image.view().at(u - 1, 240)));
    return most / std::abs(image.view().at(380, 240) - image.view().at(320, 240));
  };
  EXPECT_GT(steepest(0), 0.6);
  for (const double sigma : {2.0, 4.0})
    EXPECT_NEAR(steepest(sigma), 1 / (sigma * std::sqrt(2 * std::numbers::pi)), 0.015) << sigma;
}

TEST(Renderer, ShowsTheTextureTheRightWayRound) {
  auto texture = std::make_shared<Image>(2, 2, 3);
  texture->row(0)[0] = 255;      // upper left: blue
  texture->row(0)[3 + 1] = 255;  // upper right: green
  texture->row(1)[2] = 255;      // lower left: red
  Scene scene;
  Body quad;
  quad.shape = Shape::quad;
  quad.size = {1, 1, 1};
  quad.texture = texture;
  quad.colour = {1, 1, 1};
  scene.bodies.push_back(quad);
  RenderProfile p = clean();
  p.channels = 3;
  const Image image =
      Renderer(CameraModel{}, p).render(scene, looking_at({0, 0, 1}, {0, 0, 0}, {0, 1, 0}), 0);
  const auto brightest = [&](int u, int v) {
    const auto at = [&](int channel) { return image.view().at(u, v, channel); };
    return at(0) > 100 ? 'b' : at(1) > 100 ? 'g' : at(2) > 100 ? 'r' : '-';
  };
  EXPECT_EQ(brightest(150, 70), 'b');
  EXPECT_EQ(brightest(490, 70), 'g');
  EXPECT_EQ(brightest(150, 410), 'r');
  EXPECT_EQ(brightest(490, 410), '-');
  scene.bodies[0].T_UB.R = Vector3(1, -1, -1).asDiagonal();
  const Image behind =
      Renderer(CameraModel{}, p).render(scene, looking_at({0, 0, 1}, {0, 0, 0}, {0, 1, 0}), 0);
  EXPECT_NEAR(behind.view().at(150, 70, 2), 0.62 * 255, 1)
      << "a quad has no rear side: the background is seen";
}

TEST(RendererDeathTest, SaysWhatToInstallWhenThereIsNoEgl) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto draw = [] {
    ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1);  // as if Mesa's part were not installed
    try {
      const Renderer renderer(CameraModel{}, {});
    } catch (const FaultError& e) {
      std::fputs(e.error_line().c_str(), stderr);
      std::exit(e.fault().code == FaultCode::no_renderer ? 0 : 1);
    }
    std::exit(2);
  };
  EXPECT_EXIT(draw(), ::testing::ExitedWithCode(0), "apt-get install .*libegl-mesa0");
}

TEST(Renderer, RefusesWhatItCannotDraw) {
  const auto refused = [](CameraModel camera, RenderProfile profile) {
    EXPECT_THROW(Renderer(camera, profile), std::invalid_argument);
  };
  CameraModel camera;
  camera.fx = 0;
  refused(camera, {});
  camera = {};
  camera.distortion = {-2, 0, 0, 0, 0};  // folds inside of the picture
  refused(camera, {});
  camera = {};
  camera.width = 5000;
  refused(camera, {});
  for (const auto& spoil : std::vector<void (*)(RenderProfile&)>{
           [](RenderProfile& p) { p.samples = 0; }, [](RenderProfile& p) { p.samples = 5; },
           [](RenderProfile& p) { p.shadow_size = -1; }, [](RenderProfile& p) { p.channels = 2; },
           [](RenderProfile& p) { p.noise = -1; }, [](RenderProfile& p) { p.defocus = 11; }}) {
    RenderProfile profile;
    spoil(profile);
    refused({}, profile);
  }
  Renderer renderer(CameraModel{}, clean(fast_profile()));
  EXPECT_THROW(renderer.render(std::span<const Instant>{}, 0), std::invalid_argument);
}

}  // namespace
}  // namespace mrroc::camera
