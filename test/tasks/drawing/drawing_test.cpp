#include "tasks/drawing/drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tasks/drawing/strokes.hpp"

namespace mrroc::drawing {
namespace {

TEST(Drawing, DefaultArrowHasSixFeathersOfFortyMillimetresInsideTheDefaultSize) {
  const Drawing drawing = arrow();
  ASSERT_EQ(drawing.size(), 6u);
  for (const Stroke& feather : drawing) EXPECT_NEAR(length(feather), 39.6, 0.1);
  const Box box = bounds(drawing);
  EXPECT_NEAR(box.center().norm(), 0, 1e-12);
  EXPECT_LE(box.sizes().maxCoeff(), kDefaultSize);
  EXPECT_NO_THROW(check(drawing, "arrow"));
}

TEST(Drawing, FittingKeepsShapeAndFillsTheSizeAroundTheCentre) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-500, 900);
  for (int round = 0; round < 50; ++round) {
    Drawing drawing(3);
    for (Stroke& s : drawing)
      for (int k = 0; k < 5; ++k) s.emplace_back(anywhere(random), anywhere(random));
    const Drawing fit = fitted(drawing, 120);
    EXPECT_NEAR(bounds(fit).sizes().maxCoeff(), 120, 1e-9);
    EXPECT_NEAR(bounds(fit).center().norm(), 0, 1e-9);
    const double scale = length(fit[0]) / length(drawing[0]);
    for (std::size_t s = 0; s < 3; ++s)
      for (std::size_t k = 1; k < 5; ++k)
        EXPECT_NEAR((fit[s][k] - fit[s][0] - scale * (drawing[s][k] - drawing[s][0])).norm(), 0, 1e-9);
  }
}

TEST(Drawing, DotsWithoutExtentAreCentred) { EXPECT_EQ(fitted({{Point(7, 9)}}, 120)[0][0], Point(0, 0)); }

TEST(Drawing, RepeatedPointsBecomeOneAndDotsStay) {
  const Drawing drawing =
      without_repeats({{Point(1, 1), Point(1, 1), Point(2, 1), Point(1, 1)}, {Point(3, 3), Point(3, 3)}});
  EXPECT_EQ(drawing[0].size(), 3u);
  EXPECT_EQ(drawing[1].size(), 1u);
}

TEST(Drawing, RefusesWhatCannotBeDrawn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(check({}, "f"), FileError);
  EXPECT_THROW(check({{}}, "f"), FileError);
  EXPECT_THROW(check({{Point(0, nan)}}, "f"), FileError);
  EXPECT_THROW(check({{Point(0, -100.01)}}, "f"), FileError);
  EXPECT_NO_THROW(check({{Point(100, -100)}}, "f"));
  EXPECT_NO_THROW(check({Stroke(kMaxPoints, Point(1, 1))}, "f"));
  EXPECT_THROW(check({Stroke(kMaxPoints, Point(1, 1)), {Point(0, 0)}}, "f"), FileError);
  for (const double size : {0.0, -1.0, 200.001, nan, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(check_size(size, "f"), FileError) << size;
  EXPECT_NO_THROW(check_size(200, "f"));
}

TEST(Strokes, ResamplingIsEvenAndKeepsBothEnds) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> step(-3, 3);
  for (int round = 0; round < 30; ++round) {
    Stroke stroke{Point(0, 0)};
    for (int k = 0; k < 40; ++k) stroke.push_back(stroke.back() + Point(step(random), step(random)));
    const Stroke even = resampled(stroke, 0.2);
    EXPECT_EQ(even.front(), stroke.front());
    EXPECT_EQ(even.back(), stroke.back());
    EXPECT_NEAR(static_cast<double>(even.size() - 1), length(stroke) / 0.2, 1);
    const NearestPoint on_stroke(stroke);
    for (std::size_t k = 1; k < even.size(); ++k) {
      EXPECT_LE((even[k] - even[k - 1]).norm(), 0.2 * 1.01);
      EXPECT_LE(on_stroke.distance(even[k]), 1e-9);
    }
  }
  EXPECT_EQ(resampled({Point(1, 2)}, 0.2).size(), 1u);
  EXPECT_EQ(resampled_to({Point(1, 2)}, 7).size(), 7u);
}

TEST(Strokes, NearestPointAgreesWithASearchThroughAllSegments) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> step(-2, 2);
  std::uniform_real_distribution<double> place(-30, 30);
  for (const int corners : {1, 2, 32, 33, 34, 65, 500}) {
    Stroke stroke{Point(0, 0)};
    while (static_cast<int>(stroke.size()) < corners)
      stroke.push_back(stroke.back() + Point(step(random), step(random)));
    const NearestPoint nearest(stroke);
    for (int round = 0; round < 100; ++round) {
      const Point p(place(random), place(random));
      double least = (stroke[0] - p).norm();
      for (std::size_t k = 1; k < stroke.size(); ++k) {
        const Point along = stroke[k] - stroke[k - 1];
        const double part = std::clamp((p - stroke[k - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (stroke[k - 1] + part * along - p).norm());
      }
      EXPECT_NEAR(nearest.distance(p), least, 1e-12) << corners;
    }
  }
}

TEST(FileError, TellsTheRemedyApartFromWhatIsWrong) {
  const FileError with("a.svg", 7, "it is empty", "draw something");
  EXPECT_STREQ(with.what(), "a.svg:7: it is empty; draw something");
  EXPECT_EQ(with.wrong(), "a.svg:7: it is empty");
  EXPECT_EQ(with.remedy(), "draw something");
  const FileError without("a.svg", 0, "it is empty", "");
  EXPECT_STREQ(without.what(), "a.svg: it is empty");
  EXPECT_EQ(without.wrong(), without.what());
}

}  // namespace
}  // namespace mrroc::drawing
