// Where a tag is looked for, and which pictures are too full of edges for the full resolution.
#include "vsp/apriltag/tag_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mrroc::vsp {
namespace {

TEST(TagSearch, ReachesHalfOfTheTagsSizeBeyondIt) {
  std::mt19937 random(4);
  std::uniform_real_distribution<> at(-50, 700), size(5, 150);
  for (int run = 0; run < 300; ++run) {
    const Vector2 middle(at(random), 0.7 * at(random));
    Corners c;
    for (Vector2& p : c) p = middle + Vector2(size(random), size(random));
    double low_x = c[0].x(), low_y = c[0].y(), high_x = low_x, high_y = low_y;
    for (const Vector2& p : c) {
      low_x = std::min(low_x, p.x());
      low_y = std::min(low_y, p.y());
      high_x = std::max(high_x, p.x());
      high_y = std::max(high_y, p.y());
    }
    const double reach = std::max(24.0, 0.5 * std::max(high_x - low_x, high_y - low_y));
    const cv::Rect part = part_around(c, {0, 0, 640, 480}), far = part_around(c, {-2000, -2000, 9000, 9000});
    EXPECT_NEAR(far.x, low_x - reach, 0.51) << run;
    EXPECT_NEAR(far.y, low_y - reach, 0.51) << run;
    EXPECT_NEAR(far.width, high_x - low_x + 2 * reach, 0.51) << run;
    EXPECT_NEAR(far.height, high_y - low_y + 2 * reach, 0.51) << run;
    EXPECT_EQ(part, far & cv::Rect(0, 0, 640, 480)) << run;
  }
}

TEST(TagSearch, ReachesATinyTagByTwentyFourPixels) {
  const auto width = [](double size) {
    return part_around({Vector2(100, 100), {100 + size, 100}, {100 + size, 100 + size}, {100, 100 + size}},
                       {0, 0, 640, 480})
        .width;
  };
  EXPECT_EQ(width(0), 48);
  EXPECT_EQ(width(40), 88);
  EXPECT_EQ(width(48), 96);
  EXPECT_EQ(width(60), 120);
}

// A step of brightness in a row is seen over two columns.
TEST(TagSearch, APictureIsFullOfEdgesWithMoreThanATenthOfItsPixelsOnOne) {
  const auto with = [](int rows, int contrast, double blur = 0.1) {
    cv::Mat grey(100, 12, CV_8U, cv::Scalar(100));  // ten columns can be told from the one after the next
    grey(cv::Range(0, rows), cv::Range(6, 12)) = 120;
    return is_cluttered(grey, blur, contrast);
  };
  EXPECT_FALSE(with(0, 19));
  EXPECT_FALSE(with(50, 19)) << "100 of 1000";
  EXPECT_TRUE(with(51, 19));
  EXPECT_FALSE(with(100, 20)) << "no more than the contrast";
  EXPECT_TRUE(with(100, 9, 1.0)) << "a blurred step is seen over more columns";
  EXPECT_FALSE(with(100, 19, 1.0)) << "but is less";
  EXPECT_FALSE(with(100, 9, 8.0));
}

}  // namespace
}  // namespace mrroc::vsp
