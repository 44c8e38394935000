// Outlines by themselves: how movements of the pen become curves, and how finely these are cut.
#include "tasks/drawing/svg_outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tasks/drawing/svg_path.hpp"

namespace mrroc::drawing::svg {
namespace {

using std::numbers::pi;

Stroke flat(const Segment& segment, int count) {
  Stroke stroke;
  append(stroke, segment, count);
  return stroke;
}

void expect_points(const Stroke& stroke, const Stroke& wanted) {
  ASSERT_EQ(stroke.size(), wanted.size());
  for (std::size_t k = 0; k < stroke.size(); ++k)
    EXPECT_LT((stroke[k] - wanted[k]).norm(), 1e-12) << k << ": " << stroke[k].transpose();
}

/// @return the only curve that the path draws
Segment only(std::string_view d) {
  const std::vector<SubPath> paths = path_data(d).sub_paths(Affine::Identity());
  EXPECT_EQ(paths.size(), 1U) << d;
  EXPECT_EQ(paths.at(0).segments.size(), 1U) << d;
  return paths.at(0).segments.at(0);
}

// One control point after the other is away from zero: 27 times Bernstein's polynomials at thirds.
TEST(SvgCurves, ACubicHasTheWeightsOfBernstein) {
  const Point o(0, 0);
  expect_points(flat(Cubic{{Point(27, 0), o, o, o}}, 3), {Point(8, 0), Point(1, 0), o});
  expect_points(flat(Cubic{{o, Point(0, 27), o, o}}, 3), {Point(0, 12), Point(0, 6), o});
  expect_points(flat(Cubic{{o, o, Point(27, 0), o}}, 3), {Point(6, 0), Point(12, 0), o});
  expect_points(flat(Cubic{{o, o, o, Point(0, 27)}}, 3), {Point(0, 1), Point(0, 8), Point(0, 27)});
}

TEST(SvgCurves, AnArcGoesFromItsFirstAngleByItsSweep) {
  const double r = std::sqrt(0.5);
  expect_points(flat(Arc{{1, 2}, {2, 0}, {0, 3}, pi / 2, pi / 2}, 2),
                {Point(1 - 2 * r, 2 + 3 * r), Point(-1, 2)});
  expect_points(flat(Arc{{1, 2}, {2, 0}, {0, 3}, 0, -pi / 2}, 1), {Point(1, -1)});
}

TEST(SvgCurves, AStraightLineIsOnePiece) {
  EXPECT_EQ(pieces(only("M 1 2 L 300 400"), 1e-9), 1);
  EXPECT_EQ(pieces(Arc{{0, 0}, {3, 0}, {0, 4}, 0, 1e-9}, 1), 1);
}

// The bound is 6 times the larger of two second differences, and 24 for these; h^2 24 / 8 is the tolerance.
TEST(SvgCurves, ACubicIsCutByTheLargerOfItsSecondDifferences) {
  const auto tolerance = [](double cuts) { return 24 / 8. / (cuts * cuts); };
  for (const auto& p : {std::array{Point(0, 0), Point(0, -2), Point(0, 0), Point(0, 2)},
                        std::array{Point(0, 2), Point(0, 0), Point(0, -2), Point(0, 0)},
                        std::array{Point(4, 0), Point(0, 0), Point(0, 0), Point(0, 0)},
                        std::array{Point(0, 0), Point(0, 0), Point(0, 0), Point(4, 0)}}) {
    EXPECT_EQ(pieces(Cubic{p}, tolerance(9.5)), 10);
    EXPECT_EQ(pieces(Cubic{p}, tolerance(99.1)), 100);
  }
}

TEST(SvgCurves, AnArcIsCutByItsHalfAxesAndTheSquareOfItsSweep) {
  for (const double sweep : {2., -2.}) {
    const Segment arc = Arc{{7, 7}, {3, 0}, {0, 4}, 1, sweep};  // 5 times 4
    EXPECT_EQ(pieces(arc, 20 / 8. / (9.5 * 9.5)), 10);
    EXPECT_EQ(pieces(arc, 20 / 8. / (20.9 * 20.9)), 21);
  }
}

TEST(SvgCurves, AreFiniteWhenAllOfTheirNumbersAre) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const SubPath good{
      {0, 0},
      {Cubic{{Point(1, 2), Point(3, 4), Point(5, 6), Point(7, 8)}}, Arc{{1, 2}, {3, 4}, {5, 6}, 7, 8}}};
  EXPECT_TRUE(finite(good));
  SubPath bad = good;
  bad.start.x() = kNan;
  EXPECT_FALSE(finite(bad));
  for (std::size_t k = 0; k < 4; ++k) {
    bad = good;
    std::get<Cubic>(bad.segments[0]).p[k].y() = kNan;
    EXPECT_FALSE(finite(bad)) << k;
  }
  for (int k = 0; k < 5; ++k) {
    bad = good;
    Arc& arc = std::get<Arc>(bad.segments[1]);
    (k == 0   ? arc.centre.x()
     : k == 1 ? arc.a.y()
     : k == 2 ? arc.b.x()
     : k == 3 ? arc.from
              : arc.sweep) = kNan;
    EXPECT_FALSE(finite(bad)) << k;
  }
}

TEST(SvgCurves, ATransformedOneIsFlattenedToTheTransformedPoints) {
  const Affine T = transform("translate(5 -3) rotate(30) scale(2 -1) skewX(20)");
  const Outline outline = path_data("M 1 2 C 3 9 8 -4 5 6 A 7 4 20 1 0 9 9");
  const SubPath before = outline.sub_paths(Affine::Identity()).at(0);
  const SubPath after = outline.sub_paths(T).at(0);
  EXPECT_LT((T * before.start - after.start).norm(), 1e-12);
  ASSERT_EQ(before.segments.size(), after.segments.size());
  for (std::size_t s = 0; s < before.segments.size(); ++s) {
    Stroke wanted = flat(before.segments[s], 7);
    for (Point& p : wanted) p = T * p;
    expect_points(flat(after.segments[s], 7), wanted);
  }
}

TEST(SvgArcs, RadiiThatReachNoEndGrowInTheirRatio) {
  const Stroke half = flat(only("M 0 0 A 4 2 0 0 1 20 0"), 2);  // to 10 and 5
  EXPECT_LT((half[0] - Point(10, -5)).norm(), 1e-12);
  EXPECT_LT((half[1] - Point(20, 0)).norm(), 1e-12);
  EXPECT_LT((flat(only("M 0 0 A 4 2 90 0 1 20 0"), 2)[0] - Point(10, -20)).norm(), 1e-12) << "turned";
}

TEST(SvgArcs, SignsOfRadiiDoNotMatter) {
  const Stroke want = flat(only("M 0 0 A 9 7 30 1 1 5 3"), 5);
  for (const char* const d :
       {"M 0 0 A -9 7 30 1 1 5 3", "M 0 0 A 9 -7 30 1 1 5 3", "M 0 0 A -9 -7 210 1 1 5 3"})
    expect_points(flat(only(d), 5), want);
}

TEST(SvgArcs, WithoutARadiusOrAWayAreLines) {
  for (const char* const d : {"M 1 1 A 0 5 0 1 1 4 7", "M 1 1 A 5 0 0 1 1 4 7", "M 1 1 A 0 0 0 1 1 4 7"})
    expect_points(flat(only(d), 3), {Point(2, 3), Point(3, 5), Point(4, 7)});
  expect_points(flat(only("M 1 1 A 5 5 0 1 1 1 1"), 1), {Point(1, 1)});
  EXPECT_TRUE(std::holds_alternative<Cubic>(only("M 1 1 A 5 5 0 1 1 1 1")));
}

TEST(SvgOutlines, OneThatIsNotBegunCannotBeClosed) {
  Outline outline;
  outline.close();
  EXPECT_TRUE(outline.sub_paths(Affine::Identity()).empty());
}

TEST(SvgOutlines, ClosingDrawsTheWayBackOnce) {
  const auto curves = [](std::string_view d) {
    std::vector<std::size_t> sizes;
    for (const SubPath& path : path_data(d).sub_paths(Affine::Identity()))
      sizes.push_back(path.segments.size());
    return sizes;
  };
  using Sizes = std::vector<std::size_t>;
  EXPECT_EQ(curves("M 0 0 H 5 V 5 z"), (Sizes{3}));
  EXPECT_EQ(curves("M 0 0 H 5 V 5 z z"), (Sizes{3}));
  EXPECT_EQ(curves("M 0 0 H 5 V 5 L 0 0 z"), (Sizes{3})) << "it is there already";
  EXPECT_EQ(curves("M 3 3 z"), (Sizes{1})) << "a dot";
  EXPECT_EQ(curves("M 0 0 M 1 1 M 2 2 H 5 M 9 9"), (Sizes{1}));
  EXPECT_EQ(curves("M 0 0 H 5 V 5 z H 3 V 9 z"), (Sizes{3, 3}));
}

TEST(SvgPaths, SmoothCurvesAreMirroredOneAfterTheOther) {
  const auto end_of = [](std::string_view d) {
    const SubPath path = path_data(d).sub_paths(Affine::Identity()).at(0);
    return flat(path.segments.back(), 4);
  };
  expect_points(end_of("M 0 0 C 0 4 4 4 4 0 S 8 -4 8 0 S 12 5 13 1"),
                end_of("M 0 0 C 0 4 4 4 4 0 C 4 -4 8 -4 8 0 C 8 4 12 5 13 1"));
  expect_points(end_of("M 0 0 Q 2 4 4 0 T 8 1 T 12 0"), end_of("M 0 0 Q 2 4 4 0 Q 6 -4 8 1 Q 10 6 12 0"));
  expect_points(end_of("M 0 0 Q 2 4 4 0 S 8 5 9 0"), end_of("M 0 0 Q 2 4 4 0 C 4 0 8 5 9 0"));
  expect_points(end_of("M 0 0 Q 2 4 4 0 L 5 5 T 8 1"), end_of("M 0 0 L 5 5 Q 5 5 8 1"));
  expect_points(end_of("m 1 2 3 4 5 6"), end_of("M 1 2 L 4 6 L 9 12"));
}

TEST(SvgPaths, ACommaIsFollowedByANumber) {
  EXPECT_NO_THROW(static_cast<void>(path_data("M 1,2 , 3,4")));
  for (const char* const d :
       {"M 1 2,", "M 1 2, L 3 4", "M 1 2 z,", "M 1 2 z, 3 4", "M 1 2 z 3 4", "M,1 2,,3"})
    EXPECT_THROW(static_cast<void>(path_data(d)), BadValue) << d;
  for (const char* const d : {"", " ", "none"})
    EXPECT_TRUE(path_data(d).sub_paths(Affine::Identity()).empty()) << d;
}

}  // namespace
}  // namespace mrroc::drawing::svg
