// What is drawn into a picture, and which pictures of a long run a strip shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "base/target/board.hpp"
#include "test/vsp/picture_file_fixture.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/annotate.hpp"

namespace mrroc::vsp {
namespace {

using test::PictureFileTest;

TEST_F(PictureFileTest, DrawsWhatWasFoundAndKeepsALongRunShort) {
  Image picture(640, 480, 3);
  CameraReading reading;
  annotate(picture, reading, test::web_camera(), shape_of(kBoard), "lost");
  EXPECT_GT(picture.view().at(0, 0, 2), 200);  // a red frame
  Image seen(640, 480, 3);
  reading.seen = true;
  reading.T_CG = test::facing(0.5, 0, 0, 0);
  annotate(seen, reading, test::web_camera(), shape_of(kBoard), "seen");
  EXPECT_GT(seen.view().at(335, 240, 2), 150);  // x of G, red, to the right of the middle
  FilmStrip strip(4, 80, 8);
  for (std::int64_t k = 0; k < 1000; ++k)
    if (strip.wants(k, true)) strip.add(k, true, seen.view());
  EXPECT_EQ(strip.picture().width, 4 * 84 + 4);
  EXPECT_LE(strip.picture().height, 2 * 64 + 4);
  EXPECT_TRUE(FilmStrip().picture().empty());
}

/// @return grey levels of the pictures of a strip, one after the other
std::vector<int> shown_on(const Image& strip, int columns, int width, int height) {
  std::vector<int> grey;
  for (int y = 4; y < strip.height; y += height + 4)
    for (int k = 0; k < columns; ++k)
      grey.push_back(strip.view().at(4 + k * (width + 4) + width / 2, y + height / 2, 0));
  return grey;
}

Image plain(int grey) {
  Image picture(64, 48, 3);
  std::ranges::fill(picture.data, static_cast<std::uint8_t>(grey));
  return picture;
}

TEST(FilmStrip, ShowsEveryLookAtWhichSomethingWasReadAndSomeOfWhatWasBetween) {
  FilmStrip strip(4, 64, 16);
  for (std::int64_t k = 0; k < 2000; ++k) {
    const bool seen = k % 250 >= 246;  // eight looks of four pictures
    const int grey = seen ? 100 + static_cast<int>(k / 250) : 50;
    if (strip.wants(k, seen)) strip.add(k, seen, plain(grey).view());
  }
  const std::vector<int> grey = shown_on(strip.picture(), 4, 64, 48);
  ASSERT_EQ(grey.size(), 16U);
  EXPECT_EQ(std::ranges::count(grey, 50), 4);
  for (int look = 0; look < 8; ++look) EXPECT_GE(std::ranges::count(grey, 100 + look), 1) << look;
  std::vector<int> looks;
  std::ranges::copy_if(grey, std::back_inserter(looks), [](int g) { return g >= 100; });
  EXPECT_TRUE(std::ranges::is_sorted(looks)) << "in the order of the run";
}

TEST(FilmStrip, CoversARunInWhichNothingIsSeenEvenly) {
  FilmStrip strip(4, 64, 8);
  for (std::int64_t k = 0; k < 250; ++k)
    if (strip.wants(k, false)) strip.add(k, false, plain(static_cast<int>(k)).view());
  const std::vector<int> grey = shown_on(strip.picture(), 4, 64, 48);
  ASSERT_EQ(grey.size(), 8U);
  EXPECT_EQ(grey.front(), 0);
  for (std::size_t k = 1; k < grey.size(); ++k) EXPECT_LE(grey[k] - grey[k - 1], 64) << k;
  EXPECT_GT(grey.back(), 180);
}

}  // namespace
}  // namespace mrroc::vsp
