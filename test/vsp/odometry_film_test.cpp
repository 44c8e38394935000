// What people are shown of a platform's odometry.
#include "vsp/odometry/film.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "test/vsp/stereo_room.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {

namespace fs = std::filesystem;

/// @return whether a pixel of the picture has that colour, roughly
bool has_colour(const Image& picture, int blue, int green, int red) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const auto near = [&](int channel, int value) {
        return std::abs(picture.view().at(x, y, channel) - value) < 30;
      };
      if (near(0, blue) && near(1, green) && near(2, red)) return true;
    }
  return false;
}

TEST(OdometryPicture, ShowsPointsThatAgreeOthersAndWhyNothingWasMeasured) {
  const auto drawn = [](const OdometrySupport& support, const std::vector<SeenPoint>& seen) {
    Image picture(320, 240, 3);
    annotate(picture, support, seen);
    return picture;
  };
  const SeenPoint agreeing{{100, 150}, {110, 150}, true}, other{{200, 150}, {210, 150}, false};
  const Image good = drawn({.finding = OdometryFinding::motion}, {agreeing});
  EXPECT_TRUE(has_colour(good, 60, 200, 60));
  EXPECT_FALSE(has_colour(good, 40, 40, 230));
  EXPECT_TRUE(has_colour(drawn({.finding = OdometryFinding::motion}, {other}), 0, 210, 240));
  EXPECT_TRUE(has_colour(drawn({.finding = OdometryFinding::dark}, {}), 40, 40, 230));
}

TEST(OdometryFilm, LeavesItsPicturesWhereTheConfigurationWantsThem) {
  std::string pattern = (fs::temp_directory_path() / "odometry_film.XXXXXX").string();
  const fs::path folder = ::mkdtemp(pattern.data());
  Config config;
  config.set("film.directory=\"" + folder.string() + "\"");
  OdometryFilm film("rex", config), nowhere("rex", Config());
  film.write();
  EXPECT_FALSE(fs::exists(folder / "rex_odometry.png")) << "nothing was seen";
  test::StereoRoom room;
  test::RandomWay way(1);
  StereoOdometry odometry(test::stereo_rig());
  for (int k = 0; k < 3; ++k, way.go_on()) {
    const test::PicturePair pair = room.pair(way.T_UB(), k);
    odometry.step(pair.left.view(), pair.right.view(), k, 40 * k);
    film.see(pair.left.view(), odometry);
    nowhere.see(pair.left.view(), odometry);
  }
  film.see({}, odometry);
  film.write();
  nowhere.write();
  const Image strip = read_picture(folder / "rex_odometry.png");
  EXPECT_GE(strip.width, 3 * 320);
  EXPECT_LT(strip.height, 2 * 240);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace mrroc::vsp
