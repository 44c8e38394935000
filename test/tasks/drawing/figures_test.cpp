#include "tasks/drawing/figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mrroc::drawing {
namespace {

Drawing moved(Drawing drawing, const Rigid& motion) {
  for (Stroke& stroke : drawing)
    for (Point& p : stroke) p = motion(p);
  return drawing;
}

Drawing dense(Drawing drawing, double spacing) {
  for (Stroke& stroke : drawing) stroke = resampled(stroke, spacing);
  return drawing;
}

// A closed curve, a wave and a zigzag: nothing that a rigid motion maps onto itself.
Drawing mixture() {
  Drawing drawing(2);
  for (int k = 0; k <= 200; ++k) {
    const double u = k / 200.0;
    drawing[0].emplace_back(30 + 25 * std::cos(2 * M_PI * u), -20 + 12 * std::sin(2 * M_PI * u));
    drawing[1].emplace_back(-60 + 120 * u, 40 + 15 * std::sin(4 * M_PI * u) + 10 * u);
  }
  drawing.push_back({Point(-50, -60), Point(-30, -40), Point(-10, -60), Point(10, -40), Point(30, -60)});
  return drawing;
}

TEST(Figures, AreZeroForInkOnItsDrawing) {
  for (const Align align : {Align::none, Align::rigid}) {
    const InkFigures f = compare(dense(mixture(), 0.07), mixture(), align);
    EXPECT_NEAR(f.max_mm, 0, 0.002);
    EXPECT_EQ(f.stray_mm, 0);
    EXPECT_EQ(f.uncovered_mm, 0);
    EXPECT_EQ(f.strokes_missing + f.strokes_extra, 0);
  }
}

TEST(Figures, TeachingIsJudgedWithoutAlignment) {
  const InkFigures f =
      compare({{Point(0, 0.5), Point(50, 0.5)}}, {{Point(-1, 0), Point(60, 0)}}, Align::none);
  EXPECT_NEAR(f.rms_mm, 0.5, 1e-12);
  EXPECT_NEAR(f.max_mm, 0.5, 1e-12);
  EXPECT_EQ(f.alignment.turn, 0);
}

TEST(Figures, RootMeanSquareWeighsEveryPieceOfInkByItsLength) {
  // 30 mm on the line and 10 mm one millimetre beside it, however the points are spread.
  const InkFigures f = compare({{Point(0, 0), Point(1, 0), Point(30, 0)}, {Point(0, 1), Point(10, 1)}},
                               {{Point(0, 0), Point(30, 0)}, {Point(0, 0), Point(30, 0)}}, Align::none);
  EXPECT_NEAR(f.rms_mm, std::sqrt(10.0 / 40.0), 0.005);
}

TEST(Figures, AlignmentFindsEveryRigidMotion) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> turn(-M_PI, M_PI);
  std::uniform_real_distribution<double> shift(-40, 40);
  for (const Drawing& drawing : {arrow(), mixture()})
    for (int round = 0; round < 20; ++round) {
      const Rigid motion{turn(random), Point(shift(random), shift(random))};
      const InkFigures f = compare(moved(dense(drawing, 0.11), motion), drawing, Align::rigid);
      EXPECT_LE(f.max_mm, 0.003) << "turned by " << motion.turn;
      EXPECT_NEAR(std::remainder(f.alignment.turn + motion.turn, 2 * M_PI), 0, 1e-4);
      EXPECT_EQ(f.stray_mm, 0);
    }
}

TEST(Figures, AlignmentIsNotCaughtByNearSymmetry) {
  Drawing gear(1);  // twelve teeth, one of them longer: every twelfth of a turn nearly fits
  for (int k = 0; k <= 720; ++k) {
    const double angle = 2 * M_PI * k / 720;
    const double tooth = 8 * std::max(0.0, std::sin(12 * angle));
    gear[0].push_back(Point(std::cos(angle), std::sin(angle)) * (40 + tooth * (k < 60 ? 1.3 : 1)));
  }
  for (const double turn : {M_PI / 6, M_PI / 2, -M_PI / 3})
    EXPECT_LE(compare(moved(gear, {turn, Point(5, 5)}), gear, Align::rigid).max_mm, 0.001) << turn;
}

TEST(Figures, AlignmentNeverMirrorsAndNeverScales) {
  Drawing mirrored = mixture();
  for (Stroke& stroke : mirrored)
    for (Point& p : stroke) p.x() = -p.x();
  EXPECT_GT(compare(mirrored, mixture(), Align::rigid).rms_mm, 3);
  Drawing larger = mixture();
  for (Stroke& stroke : larger)
    for (Point& p : stroke) p *= 1.1;
  EXPECT_GT(compare(larger, mixture(), Align::rigid).rms_mm, 1);
}

/// @return sum of squared distances of the ink, moved, from the strokes with its numbers [mm^2]
double squares(const Drawing& ink, const Drawing& reference, const Rigid& motion) {
  double sum = 0;
  for (std::size_t s = 0; s < ink.size(); ++s) {
    const NearestPoint nearest(reference[s]);
    for (const Point& p : resampled(ink[s], kSampleSpacing)) sum += std::pow(nearest.distance(motion(p)), 2);
  }
  return sum;
}

// Ink whose lengths are not shared as those of the reference are, so that neither start is near.
TEST(Figures, NoOtherMotionBringsTheInkNearerThanTheAlignment) {
  std::mt19937 random(10);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int round = 0; round < 20; ++round) {
    Drawing reference = mixture();
    reference.resize(1 + static_cast<std::size_t>(round % 3));
    Drawing ink = moved(dense(reference, 0.4), {0.3 * any(random), Point(8 * any(random), 8 * any(random))});
    for (Stroke& stroke : ink) {
      const double wave = 1 + any(random);
      for (std::size_t k = 0; k < stroke.size(); ++k)
        stroke[k] += Point(0.8 * std::sin(0.05 * wave * static_cast<double>(k)),
                           0.5 * std::cos(0.08 * wave * static_cast<double>(k)));
      stroke.resize(stroke.size() - stroke.size() / 8);
    }
    const Rigid best = best_alignment(ink, reference);
    const double least = squares(ink, reference, best);
    for (const double turn : {-1e-3, 0.0, 1e-3})
      for (const double x : {-0.05, 0.0, 0.05})
        for (const double y : {-0.05, 0.0, 0.05})
          EXPECT_GE(squares(ink, reference, {best.turn + turn, best.shift + Point(x, y)}), least * (1 - 1e-4))
              << round << ": " << turn << ' ' << x << ' ' << y;
  }
}

TEST(Figures, AlignmentLeavesTheNoiseAndTakesTheMotionAway) {
  std::mt19937 random(8);
  std::normal_distribution<double> noise(0, 0.1);
  Drawing ink = moved(dense(mixture(), 0.5), {0.05, Point(2, -3)});
  for (Stroke& stroke : ink)
    for (Point& p : stroke) p += Point(noise(random), noise(random));
  const InkFigures f = compare(ink, mixture(), Align::rigid);
  EXPECT_NEAR(f.rms_mm, 0.1, 0.03);
  EXPECT_LT(f.max_mm, 0.6);
  EXPECT_NEAR(f.alignment.turn, -0.05, 1e-3);
}

TEST(Figures, AlignmentIsNoWorseThanNone) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> step(-2, 2);
  for (int round = 0; round < 20; ++round) {
    Drawing ink = mixture();
    for (Stroke& stroke : ink)
      for (Point& p : stroke) p += Point(step(random), step(random));
    EXPECT_LE(compare(ink, mixture(), Align::rigid).rms_mm,
              compare(ink, mixture(), Align::none).rms_mm + 0.01);
  }
}

TEST(Figures, ErrorsAreDistancesToTheStrokeWithTheSameNumber) {
  // Ink on the wrong one of two parallel strokes is no stray ink, but it is an error.
  const Drawing reference{{Point(0, 0), Point(50, 0)}, {Point(0, 10), Point(50, 10)}};
  const InkFigures f = compare({reference[0], reference[0]}, reference, Align::none);
  EXPECT_NEAR(f.max_mm, 10, 1e-12);
  EXPECT_EQ(f.stray_mm, 0);
  EXPECT_NEAR(f.uncovered_mm, 50, 1e-6);
}

TEST(Figures, StrayInkIsItsLengthFarFromEveryStroke) {
  const InkFigures f =
      compare({{Point(0, 0), Point(50, 0), Point(50, 11.5)}}, {{Point(0, 0), Point(50, 0)}}, Align::none);
  EXPECT_NEAR(f.stray_mm, 10, 0.2);
  const InkFigures dot =
      compare({{Point(0, 0), Point(50, 0)}, {Point(0, 30)}}, {{Point(0, 0), Point(50, 0)}}, Align::none);
  EXPECT_NEAR(dot.stray_mm, kSampleSpacing, 1e-12);
  EXPECT_EQ(dot.strokes_extra, 1);
  EXPECT_NEAR(dot.max_mm, 30, 1e-12);
}

TEST(Figures, InkThatEndsTooEarlyLeavesTheReferenceUncovered) {
  const InkFigures f = compare({{Point(0, 0), Point(20, 0)}}, {{Point(0, 0), Point(50, 0)}}, Align::none);
  EXPECT_NEAR(f.uncovered_mm, 30 - kStrayDistance, 0.2);
  EXPECT_NEAR(f.max_mm, 0, 1e-12);
}

TEST(Figures, MissingStrokesMakeTheFiguresLargeButFinite) {
  Drawing ink = arrow();
  ink.pop_back();
  ink[1].clear();
  const InkFigures f = compare(ink, arrow(), Align::rigid);
  EXPECT_EQ(f.strokes_missing, 2);
  EXPECT_EQ(f.max_mm, kMissingError);
  EXPECT_GT(f.rms_mm, 100);
  EXPECT_TRUE(std::isfinite(f.rms_mm));
  EXPECT_NEAR(f.uncovered_mm, 2 * length(arrow()[0]), 1e-6);
  const InkFigures none = compare({}, arrow(), Align::rigid);
  EXPECT_EQ(none.strokes_missing, 6);
  EXPECT_NEAR(none.rms_mm, kMissingError, 1e-9);
  const InkFigures nothing_asked = compare(arrow(), {}, Align::rigid);
  EXPECT_EQ(nothing_asked.strokes_extra, 6);
  EXPECT_EQ(nothing_asked.max_mm, kMissingError);
}

TEST(Figures, TenMetresOfInkAreJudgedInAMoment) {  // the test's time limit is the bar
  Drawing reference(1);
  for (int k = 0; k <= 50'000; ++k) {
    const double u = k / 50'000.0;
    reference[0].emplace_back(90 * u * std::cos(200 * u), 90 * u * std::sin(200 * u));
  }
  const InkFigures f = compare(moved(reference, {0.02, Point(1, 0)}), reference, Align::rigid);
  EXPECT_LE(f.max_mm, 0.005);
}

}  // namespace
}  // namespace mrroc::drawing
