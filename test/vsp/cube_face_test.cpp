// The receptor of the cube's faces on pictures of one plane, made without the renderer: nine colours from a face
// that is about where it should be, and never a valid reading of anything else.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "base/fault.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/cube_face/cube_face_sensor.hpp"

namespace mrroc::vsp {
namespace {

using test::facing;
using test::PlaneCamera;
using Colours = std::array<int, kStickers>;
using Rgb = std::array<float, 3>;

constexpr std::array<Rgb, kStickerColours> kPaint{{{0.86F, 0.86F, 0.84F},
                                                   {0.68F, 0.06F, 0.07F},
                                                   {0.05F, 0.52F, 0.19F},
                                                   {0.84F, 0.76F, 0.07F},
                                                   {0.90F, 0.36F, 0.06F},
                                                   {0.05F, 0.19F, 0.58F}}};
constexpr Rgb kTable{0.4F, 0.42F, 0.45F};
constexpr float kPlastic = 0.035F;

CameraModel small_camera() {
  CameraModel camera;
  camera.width = 240;
  camera.height = 200;
  camera.fx = camera.fy = 900;
  camera.cx = 119.5;
  camera.cy = 99.5;
  camera.distortion = {-0.2, 0.05, 0.0006, -0.0004, 0};
  return camera;
}

/// What lies over the face or is done to its picture.
struct Look {
  std::array<float, 3> lamp{220, 220, 220};  ///< grey levels of white
  test::Exposure exposure{.blur = 0.6, .noise = 2};
  double bar{1};  ///< a grey bar covers everything to the right of it [m]
};

class Faces {
 public:
  explicit Faces(unsigned seed) : random_(seed) {}

  Colours colours() {
    Colours all{};
    for (int& c : all) c = pick(kStickerColours);
    return all;
  }
  static Pose place() { return facing(0.45, 0.5, 0.7, 0.4); }
  Pose near(double shift, double turn) {
    const auto u = [this](double a) { return uniform(-a, a); };
    const Pose T = place();
    return {rotation_from_angle_axis({u(turn), u(turn), u(turn)}) * T.R,
            T.p + Vector3(u(shift), u(shift), u(shift))};
  }

  Image picture(const Pose& T_CG, const Colours& colours, Look look = {}) {
    const auto channel = [&](std::size_t c) {
      look.exposure.seed = static_cast<unsigned>(random_());
      return camera().render(
          T_CG,
          [&colours, &look, c](double x, double y) {
            return look.lamp[c] * (x > look.bar ? 0.5F : reflected(colours, x, y, c));
          },
          look.exposure);
    };
    const std::array<Image, 3> rgb{channel(0), channel(1), channel(2)};
    Image result(rgb[0].width, rgb[0].height, 3);
    for (std::size_t k = 0; k < rgb[0].data.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) result.data[3 * k + 2 - c] = rgb[c].data[k];
    return result;
  }

  int pick(int n) { return std::uniform_int_distribution<>(0, n - 1)(random_); }
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }

 private:
  static const PlaneCamera& camera() {
    static const PlaneCamera shared(small_camera(), 2);
    return shared;
  }
  static float reflected(const Colours& colours, double x, double y, std::size_t c) {
    const double half = kCubeFace.edge / 2;
    if (std::max(std::abs(x), std::abs(y)) > half) return kTable[c];
    for (int k = 0; k < kStickers; ++k) {
      const Vector3 m = kCubeFace.middle(k);
      if (std::max(std::abs(x - m.x()), std::abs(y - m.y())) < kCubeFace.sticker / 2)
        return kPaint[static_cast<std::size_t>(colours[static_cast<std::size_t>(k)])][c];
    }
    return kPlastic;
  }

  std::mt19937 random_;
};

CubeFaceReading read(const Image& picture) {
  static const CubeFaceSensor sensor(small_camera(), {Faces::place()});
  return sensor.detect(picture.view(), 3, 60);
}

void expect_colours(const CubeFaceReading& reading, const Colours& colours) {
  for (std::size_t k = 0; k < kStickers; ++k)
    EXPECT_EQ(static_cast<int>(reading.stickers[k].colour), colours[k]) << k;
}

TEST(CubeFace, ReadsNineColoursAndThePose) {
  Faces faces(1);
  for (int n = 0; n < 5; ++n) {
    const Colours colours = faces.colours();
    const Pose T = faces.near(0.004, 0.03);
    const CubeFaceReading reading = read(faces.picture(T, colours));
    EXPECT_EQ(reading.frame, 3);
    EXPECT_EQ(reading.step, 60);
    ASSERT_TRUE(reading.seen) << n;
    EXPECT_TRUE(reading.valid) << n;
    EXPECT_EQ(reading.place, 0);
    expect_colours(reading, colours);
    EXPECT_LT((reading.T_CG.p - T.p).head<2>().norm(), 3e-4);
    EXPECT_LT(std::abs(reading.T_CG.p.z() - T.p.z()), 4e-3);
    EXPECT_LT(angle_axis_from_rotation(reading.T_CG.R * T.R.transpose()).norm(), 0.03);
    EXPECT_LT(reading.reprojection_px, 0.4);
    EXPECT_GT(reading.covariance(2, 2), 0);
  }
}

TEST(CubeFace, NamesColoursInDimAndTintedLightOrSaysThatItIsNotSure) {
  Faces faces(2);
  int valid = 0;
  constexpr int kPictures = 6;
  for (int n = 0; n < kPictures; ++n) {
    const Colours colours = faces.colours();
    Look look;
    const auto light = static_cast<float>(faces.uniform(50, 220));
    for (float& c : look.lamp) c = light * static_cast<float>(faces.uniform(0.75, 1.1));
    const CubeFaceReading reading = read(faces.picture(faces.near(0.003, 0.02), colours, look));
    EXPECT_TRUE(reading.seen);
    if (!reading.valid) continue;
    ++valid;
    expect_colours(reading, colours);
  }
  EXPECT_GT(valid, kPictures / 2);
}

TEST(CubeFace, ABarOverStickersHidesThem) {
  Faces faces(3);
  for (const double bar : {0.0245, 0.018}) {
    const CubeFaceReading reading =
        read(faces.picture(faces.near(0.002, 0.01), faces.colours(), {.bar = bar}));
    EXPECT_FALSE(reading.valid) << bar;
    if (!reading.seen) continue;
    for (const std::size_t k : {2U, 5U, 8U}) {
      EXPECT_NE(reading.stickers[k].flaw, StickerFlaw::none) << bar;
      EXPECT_EQ(reading.stickers[k].confidence, 0);
    }
  }
}

TEST(CubeFace, SaysNothingOfAFaceThatIsNotAtItsPlace) {
  Faces faces(4);
  for (const Vector3& by : {Vector3(0.0095, 0, 0), Vector3(0, 0.019, 0), Vector3(0.03, 0.03, 0)}) {
    Pose T = Faces::place();
    T.p += T.R * by;
    EXPECT_FALSE(read(faces.picture(T, faces.colours())).valid) << by.transpose();
  }
  const Pose eighth{Faces::place().R * rotation_from_angle_axis({0, 0, std::numbers::pi / 4}),
                    Faces::place().p};
  EXPECT_FALSE(read(faces.picture(eighth, faces.colours())).seen);
}

TEST(CubeFace, TellsBlurredOverexposedAndBlackPictures) {
  Faces faces(5);
  const Colours colours = faces.colours();
  const Pose T = Faces::place();
  Look look;
  look.exposure.blur = 7;
  EXPECT_FALSE(read(faces.picture(T, colours, look)).valid);
  look.exposure.blur = 0.6;
  look.lamp = {6000, 6000, 6000};
  EXPECT_FALSE(read(faces.picture(T, colours, look)).valid);
  look.lamp = {6, 6, 6};
  EXPECT_FALSE(read(faces.picture(T, colours, look)).valid);
  const CubeFaceReading black = read(Image(240, 200, 3));
  EXPECT_FALSE(black.seen);
  EXPECT_EQ(black.place, -1);
}

TEST(CubeFace, RefusesPicturesThatAreNoneOfItsCamera) {
  EXPECT_FALSE(read(Image(200, 240, 3)).seen);
  EXPECT_FALSE(read(Image(240, 200, 1)).seen);
  EXPECT_FALSE(read(Image()).seen);
}

TEST(CubeFace, NothingElseIsAFace) {
  Faces faces(6);
  for (int n = 0; n < 15; ++n) {
    Image noise(240, 200, 3);
    const int cell = 1 + faces.pick(24);
    std::vector<std::uint8_t> values(20'000);
    for (auto& v : values) v = static_cast<std::uint8_t>(faces.pick(256));
    for (int y = 0; y < noise.height; ++y)
      for (int x = 0; x < 3 * noise.width; ++x)
        noise.row(y)[x] =
            values[static_cast<std::size_t>((y / cell) * 91 + (x / 3 / cell) * 7 + x % 3) % 20'000];
    EXPECT_FALSE(read(noise).valid) << n;
  }
}

TEST(CubeFace, TellsWhichPlace) {
  Faces faces(7);
  Pose other = Faces::place();
  other.p += Vector3(0.012, -0.01, 0.02);
  const CubeFaceSensor sensor(small_camera(), {other, Faces::place()});
  const Colours colours = faces.colours();
  EXPECT_EQ(sensor.detect(faces.picture(Faces::place(), colours).view(), 0, 0).place, 1);
  EXPECT_EQ(sensor.detect(faces.picture(other, colours).view(), 0, 0).place, 0);
}

TEST(CubeFace, RefusesPlacesThatCannotBeSeen) {
  EXPECT_THROW(CubeFaceSensor(small_camera(), {}), FaultError);
  EXPECT_THROW(CubeFaceSensor(small_camera(), {facing(0.45, 1.2, 0, 0)}), FaultError);
  EXPECT_THROW(CubeFaceSensor(small_camera(), {facing(0.45, 0, 0, 0, 0.2)}), FaultError);
  EXPECT_THROW(CubeFaceSensor(small_camera(), {Pose{}}), FaultError);
}

TEST(CubeFace, RefusesWithTheReason) {
  const auto why = [](const CameraModel& camera, const std::vector<Pose>& places) -> std::string {
    try {
      const CubeFaceSensor sensor(camera, places);
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
      return e.what();
    }
    return "";
  };
  CameraModel broken = small_camera();
  broken.fx = 0;
  EXPECT_NE(why(broken, {Faces::place()}).find("the camera's model is not proper"), std::string::npos);
  EXPECT_NE(why(small_camera(), {}).find("there is no place where a face of the cube is shown"),
            std::string::npos);
  EXPECT_NE(why(small_camera(), {Faces::place(), Pose{}})
                .find("a face of the cube at one of its places is not in the picture, or seen at more than "
                      "60 degrees"),
            std::string::npos);
  EXPECT_EQ(why(small_camera(), {Faces::place()}), "");
}

// All of a face must be in the picture, seen at less than 60 degrees, and not nearer than its own edge.
TEST(CubeFace, APlaceMustBeInThePictureAndNotTooSlanted) {
  CameraModel camera = small_camera();
  camera.distortion = {};
  const auto can = [&camera](const Pose& place) {
    try {
      const CubeFaceSensor sensor(camera, {place});
    } catch (const FaultError&) {
      return false;
    }
    return true;
  };
  EXPECT_TRUE(can(facing(0.6, 1.03, 0, 0)));
  EXPECT_FALSE(can(facing(0.6, 1.06, 0, 0)));
  EXPECT_FALSE(can({Matrix3::Identity(), {0, 0, 0.6}})) << "from behind";
  // 900 / 0.6 = 1500 pixels for a metre: half of the face takes 42.75 of the 119.5 or 99.5 to the picture's border.
  for (const double sign : {1., -1.}) {
    EXPECT_TRUE(can(facing(0.6, 0, 0, 0, sign * 76.6 / 1500)));
    EXPECT_FALSE(can(facing(0.6, 0, 0, 0, sign * 76.9 / 1500)));
    EXPECT_TRUE(can(facing(0.6, 0, 0, 0, 0, sign * 56.6 / 1500)));
    EXPECT_FALSE(can(facing(0.6, 0, 0, 0, 0, sign * 56.9 / 1500)));
  }
  camera.fx = camera.fy = 90;
  EXPECT_TRUE(can(facing(0.058, 0, 0, 0)));
  EXPECT_FALSE(can(facing(0.056, 0, 0, 0)));
  Pose crooked = Faces::place();
  crooked.R *= 1.1;
  EXPECT_FALSE(can(crooked));
}

// The edges of the stickers tell where the face is, and how exactly they do.
TEST(CubeFace, CovarianceIsThatOfManyPictures) {
  Faces faces(8);
  const Colours white{};
  Vector3 squares = Vector3::Zero(), told = Vector3::Zero();
  constexpr int kPictures = 8;
  for (int n = 0; n < kPictures; ++n) {
    const Pose T = faces.near(0.003, 0.02);
    const CubeFaceReading r = read(faces.picture(T, white));
    ASSERT_TRUE(r.seen);
    squares += (r.T_CG.p - T.p).cwiseAbs2() / kPictures;
    told += r.covariance.diagonal().head<3>() / kPictures;
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(std::sqrt(squares[k]), 4 * std::sqrt(told[k])) << k;
    EXPECT_GT(std::sqrt(squares[k]), 0.05 * std::sqrt(told[k])) << k;
  }
}

TEST(CubeFace, ThresholdsAreTheDocumentedOnesUnlessTheConfigurationSaysOtherwise) {
  const CubeFaceParameters k;
  EXPECT_EQ(k.place_error, 0.006);
  EXPECT_EQ(k.angle_error, 0.06);
  EXPECT_EQ(k.contrast, 6);
  EXPECT_EQ(k.rms_px, 0.6);
  EXPECT_EQ(k.edge_share, 0.6);
  EXPECT_EQ(k.glare_share, 0.67);
  EXPECT_EQ(k.dark, 8);
  EXPECT_EQ(k.veil, 0.1);
  EXPECT_EQ(k.confidence, 0.95);
}

}  // namespace
}  // namespace mrroc::vsp
