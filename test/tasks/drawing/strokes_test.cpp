// Polylines, ink and figures at their bounds, on drawings that can be reckoned by hand.
#include "tasks/drawing/strokes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "base/fault.hpp"
#include "tasks/drawing/doubtful.hpp"
#include "tasks/drawing/figures.hpp"
#include "tasks/drawing/pen_strokes.hpp"
#include "tasks/drawing/svg.hpp"

namespace mrroc::drawing {
namespace {

using enum PenState;

TEST(Strokes, LengthIsTheSumOfTheirPieces) {
  EXPECT_EQ(length({}), 0);
  EXPECT_EQ(length({Point(7, 7)}), 0);
  EXPECT_EQ(length({Point(0, 0), Point(3, 4), Point(3, 4), Point(3, 10)}), 11);
}

TEST(Strokes, BoundsHoldEveryPointOfEveryStroke) {
  const Box box = bounds({{Point(1, 2), Point(-3, 0)}, {}, {Point(0, 9)}});
  EXPECT_EQ(box.min(), Point(-3, 0));
  EXPECT_EQ(box.max(), Point(1, 9));
  EXPECT_TRUE(bounds({{}}).isEmpty());
}

void expect_points(const Stroke& stroke, const Stroke& wanted) {
  ASSERT_EQ(stroke.size(), wanted.size());
  for (std::size_t k = 0; k < stroke.size(); ++k)
    EXPECT_LT((stroke[k] - wanted[k]).norm(), 1e-12) << k << ": " << stroke[k].transpose();
}

TEST(Strokes, ResampledPointsLieAtEqualSharesOfTheWayRoundCorners) {
  const Stroke corner{Point(0, 0), Point(1, 0), Point(1, 0), Point(1, 5)};
  expect_points(resampled_to(corner, 4), {Point(0, 0), Point(1, 1), Point(1, 3), Point(1, 5)});
  expect_points(resampled_to(corner, 2), {Point(0, 0), Point(1, 5)});
  expect_points(resampled_to(corner, 7),
                {Point(0, 0), Point(1, 0), Point(1, 1), Point(1, 2), Point(1, 3), Point(1, 4), Point(1, 5)});
  EXPECT_TRUE(resampled_to({}, 4).empty());
}

TEST(Strokes, AreCutIntoTheNumberOfPiecesThatComesNearestToTheSpacing) {
  const auto points = [](double length_mm, double spacing) {
    return resampled({Point(0, 0), Point(length_mm, 0)}, spacing).size();
  };
  EXPECT_EQ(points(10, 2), 6U);
  EXPECT_EQ(points(10, 2.2), 6U) << "4.5 and a little";
  EXPECT_EQ(points(10, 2.3), 5U);
  EXPECT_EQ(points(10, 100), 2U) << "one piece at least";
  EXPECT_EQ(points(0, 2), 1U) << "a dot";
  EXPECT_TRUE(resampled({}, 2).empty());
}

TEST(Strokes, TheNearestPointIsOnASegmentOrAtItsEnd) {
  const NearestPoint line({Point(0, 0), Point(10, 0), Point(10, 0), Point(10, 10)});
  EXPECT_EQ(line({3, 4}), Point(3, 0));
  EXPECT_EQ(line({-3, 4}), Point(0, 0));
  EXPECT_EQ(line({12, 7}), Point(10, 7));
  EXPECT_EQ(line({12, 17}), Point(10, 10));
  EXPECT_EQ(line.distance({-3, 4}), 5);
  EXPECT_EQ(NearestPoint({Point(2, 2)})({9, 9}), Point(2, 2));
}

TEST(Drawing, IsFittedByItsLargerSideAndCentred) {
  expect_points(fitted({{Point(1, 1), Point(3, 5)}}, 100)[0], {Point(-25, -50), Point(25, 50)});
  expect_points(fitted({{Point(1, 1), Point(9, 5)}}, 100)[0], {Point(-50, -25), Point(50, 25)});
  EXPECT_TRUE(fitted({}, 100).empty());
}

TEST(Drawing, MayFillTheSheetButNotLeaveIt) {
  const double edge = kSheetSize / 2;
  EXPECT_NO_THROW(check({{Point(edge, -edge), Point(-edge, edge)}}, "f"));
  for (const Point& p : {Point(edge + 1e-3, 0), Point(0, -edge - 1e-3)})
    EXPECT_THROW(check({{Point(0, 0), p}}, "f"), FileError);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(check({{Point(0, 0), Point(0, bad)}}, "f"), FileError);
  EXPECT_NO_THROW(check({{Point(0, 0), Point(1, 0)}, {Point(2, 0)}}, "f", 3));
  EXPECT_THROW(check({{Point(0, 0), Point(1, 0)}, {Point(2, 0)}}, "f", 2), FileError);
  EXPECT_THROW(check({{Point(0, 0)}, {}}, "f"), FileError);
}

TEST(Drawing, OnlyNeighboursThatAreTheSameBecomeOne) {
  const Stroke stroke{Point(0, 0), Point(1e-7, 0), Point(1e-5, 0), Point(0, 0)};
  expect_points(without_repeats({stroke})[0], {Point(0, 0), Point(1e-5, 0), Point(0, 0)});
}

TEST(Ink, AHopIsShorterThanALift) {
  const auto strokes = [](double pause) {
    return without_hops({{0, 1, 0, 0}, {1, 1 + pause, 0, 0}, {1, 2 + pause, 0, 0}}).back().stroke;
  };
  EXPECT_EQ(strokes(kHopTime - 1e-9), 0);
  EXPECT_EQ(strokes(kHopTime + 1e-9), 1);
}

TEST(Ink, OneThatIsNotFiniteIsNotWritten) {
  const auto file = std::filesystem::path(testing::TempDir()) / "strokes_test_ink.csv";
  std::filesystem::remove(file);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const InkPoint& bad : {InkPoint{0, kNan, 0, 0}, {0, 0, kNan, 0}, {0, 0, 0, kNan}}) {
    EXPECT_THROW(write_ink(file, {bad}), FaultError);
    EXPECT_FALSE(std::filesystem::exists(file));
  }
}

TEST(Ink, ARecordingThatIsNotFiniteIsNoText) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Recording recording = Recording(0.02).appended({{}, paper_surface});
  for (const InkPoint& bad : {InkPoint{0, kNan, 0, 0}, {0, 0, kNan, 0}, {0, 0, 0, kNan}})
    EXPECT_THROW((void)recording_text({recording, {bad}}, "f"), FileError);
  for (const Axis a : kAxes) {
    Node node{{}, paper_surface};
    node.velocity[a] = kNan;
    EXPECT_THROW((void)recording_text({Recording(0.02).appended(node), {}}, "f"), FileError);
  }
}

TEST(Recordings, AMacrostepLastsUpToASecond) {
  const auto parsed = [](double s) {
    return parse_recording(recording_text({Recording(s).appended({{}, paper_surface}), {}}, "f"), "f");
  };
  EXPECT_EQ(parsed(1).recording.macrostep_s(), 1);
  EXPECT_EQ(parsed(1e-6).recording.macrostep_s(), 1e-6);
  for (const double bad : {0., -0.02, 1.000001}) EXPECT_THROW((void)parsed(bad), FileError) << bad;
}

TEST(Recordings, OfEqualNodesAreEqualWhateverBuffersTheyAreIn) {
  const auto made = [](int n, double last) {
    Recording r(0.02);
    for (int k = 0; k < n; ++k) r = r.appended({Twist{{k == n - 1 ? last : 1.}}, paper_surface});
    return r;
  };
  EXPECT_EQ(made(3, 5), made(3, 5));
  EXPECT_NE(made(3, 5), made(3, 6)) << "the last node counts, too";
  EXPECT_NE(made(3, 1), made(4, 1));
  EXPECT_TRUE(made(0, 0).empty());
  EXPECT_FALSE(made(1, 0).empty());
}

Recording nodes(std::initializer_list<std::pair<PenState, int>> runs) {
  Recording r(0.02);
  for (const auto& [pen, n] : runs)
    for (int k = 0; k < n; ++k) r = r.appended({Twist{{static_cast<double>(r.size())}}, pen});
  return r;
}

std::vector<PenState> pens(const Recording& r) {
  std::vector<PenState> all;
  for (std::size_t n = 0; n < r.size(); ++n) all.push_back(r[n].pen);
  return all;
}

TEST(FalseTouches, SeveralBeforeTheFirstRealOneAreAllLeftOut) {
  const Recording r = without_false_touches(
      nodes({{paper_surface, 2}, {lowering, 1}, {paper_surface, 1}, {lowering, 3}, {paper_surface, 2}}));
  EXPECT_EQ(pens(r), (std::vector{paper_surface, paper_surface}));
  EXPECT_EQ(r[0].velocity[Axis::x], 7);
  EXPECT_EQ(r.macrostep_s(), 0.02);
}

TEST(FalseTouches, OfTheWayToTheFirstOneNothingIsLeftEither) {
  const Recording r = without_false_touches(
      nodes({{above_paper, 2}, {lowering, 1}, {paper_surface, 2}, {lowering, 1}, {paper_surface, 3}}));
  EXPECT_EQ(pens(r), (std::vector{paper_surface, paper_surface, paper_surface}));
  EXPECT_EQ(r[0].velocity[Axis::x], 6);
}

TEST(FalseTouches, ARunThatEndsOtherwiseThanInLoweringIsReal) {
  for (const auto& fine :
       {nodes({{paper_surface, 2}}), nodes({{paper_surface, 2}, {lift_off, 1}}),
        nodes({{paper_surface, 2}, {above_paper, 1}}), nodes({{lowering, 2}, {paper_surface, 2}}),
        nodes({{above_paper, 2}, {lowering, 1}, {paper_surface, 1}})})
    EXPECT_EQ(without_false_touches(fine), fine);
}

TEST(FalseTouches, AfterTheFirstRealOneTheyBecomeLowering) {
  const Recording r = without_false_touches(nodes({{paper_surface, 1},
                                                   {lift_off, 1},
                                                   {paper_surface, 2},
                                                   {lowering, 1},
                                                   {paper_surface, 1},
                                                   {lowering, 1}}));
  EXPECT_EQ(pens(r),
            (std::vector{paper_surface, lift_off, lowering, lowering, lowering, lowering, lowering}));
}

TEST(PaperTimes, OfATraceAreThoseOfDrawing) {
  mp::ArmTrace trace;
  for (const int m : {4, 5, 5, 6, 7, 5, 6}) {
    mp::ArmRow& row = trace.emplace_back();
    row.m = m;
    row.t = static_cast<double>(trace.size());
  }
  const auto times = paper_times(trace);
  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times[0].begin, 2);
  EXPECT_EQ(times[0].end, 3);
  EXPECT_EQ(times[1].begin, 6);
  EXPECT_EQ(times[1].end, 6);
}

TEST(PaperTimes, NodesWithoutATimeAreLeftOut) {
  const Recording r = nodes({{paper_surface, 4}});
  const auto times = paper_times(r, {1, 1.02});
  ASSERT_EQ(times.size(), 1U);
  EXPECT_DOUBLE_EQ(times[0].begin, 0.98);
  EXPECT_EQ(times[0].end, 1.02);
  EXPECT_EQ(paper_times(nodes({{paper_surface, 1}}), {1, 2, 3}).size(), 1U);
}

TEST(WrongStrokes, ATimeThatTouchesAStrokeBelongsToIt) {
  const Ink ink{{0, 1, 0, 0}, {0, 2, 0, 0}};
  EXPECT_EQ(wrong_strokes(ink, {{2, 3}}), 0);
  EXPECT_EQ(wrong_strokes(ink, {{0, 1}}), 0);
  EXPECT_EQ(wrong_strokes(ink, {{2.01, 3}}), 2) << "one is lost, one made up";
  EXPECT_EQ(wrong_strokes(ink, {{0, 0.99}}), 2);
}

TEST(WrongStrokes, EachEndMayBeMissingUpToTheDistanceOfStrayInk) {
  for (const double missing : {kStrayDistance - 1e-6, kStrayDistance + 1e-6})
    for (const bool at_begin : {false, true}) {
      // Three points, of which the first or the last one was not said to be on the paper; it may lie aside.
      const Ink ink = at_begin ? Ink{{0, 1, 0, 0.6 * missing}, {0, 2, 0.8 * missing, 0}, {0, 3, 9, 9}}
                               : Ink{{0, 1, 9, 9}, {0, 2, 0.8 * missing, 0}, {0, 3, 0, 0.6 * missing}};
      const PaperTime said = at_begin ? PaperTime{1.5, 3} : PaperTime{1, 2.5};
      EXPECT_EQ(wrong_strokes(ink, {said}), missing > kStrayDistance) << at_begin;
    }
}

/// A pen that goes on the paper for 2 m, then lifts to a height, moves along, and comes back.
Recording travel(double height, double along, PenState pen = above_paper) {
  Recording r(0.02);
  const auto go = [&](PenState state, double x, double z, int n = 50) {
    for (int k = 0; k < n; ++k) r = r.appended({Twist{{x / n / 0.02, 0, z / n / 0.02, 0, 0, 0}}, state});
  };
  go(paper_surface, 2, 0, 500);
  go(pen, 0, -height, 1);
  go(pen, along, 0);
  go(pen, 0, height, 1);
  go(paper_surface, 2, 0, 500);
  return r;
}

TEST(DoubtfulStrokes, APenThatMovesLowInTheAirSmears) {
  EXPECT_EQ(doubtful_strokes(travel(0.9 * kLowTravel, 1.1 * kSmear)), 1);
  EXPECT_EQ(doubtful_strokes(travel(0.9 * kLowTravel, 0.9 * kSmear)), 0) << "not far enough";
  EXPECT_EQ(doubtful_strokes(travel(1.1 * kLowTravel, 1.1 * kSmear)), 0) << "high enough";
}

TEST(DoubtfulStrokes, ARunOnThePaperIsDoubtfulFarFromItsPlane) {
  const auto with_step = [](double height) {
    Recording r(0.02);
    const auto go = [&](PenState state, double x, double z, int n) {
      for (int k = 0; k < n; ++k) r = r.appended({Twist{{x / n / 0.02, 0, z / n / 0.02, 0, 0, 0}}, state});
    };
    go(paper_surface, 0.2, 0, 2000);
    go(lift_off, 0, -height, 1);
    go(paper_surface, 0.001, 0, 2);
    go(lift_off, 0, height, 1);
    go(paper_surface, -0.2, 0, 2000);
    return r;
  };
  EXPECT_EQ(doubtful_strokes(with_step(1.1 * kOffPaper)), 1);
  EXPECT_EQ(doubtful_strokes(with_step(0.9 * kOffPaper)), 0);
  EXPECT_EQ(doubtful_strokes(with_step(-1.1 * kOffPaper)), 1) << "in the table, too";
}

TEST(Figures, AStrokeOfInkBesideItsReferenceStraysFromThatDistanceOn) {
  const auto stray = [](double off) {
    return compare({{Point(0, off), Point(10, off)}}, {{Point(-5, 0), Point(15, 0)}}, Align::none);
  };
  EXPECT_EQ(stray(kStrayDistance - 1e-6).stray_mm, 0);
  EXPECT_NEAR(stray(kStrayDistance + 1e-6).stray_mm, 10, 1e-9);
  EXPECT_NEAR(stray(kStrayDistance + 1e-6).uncovered_mm, 20, 1e-9);
  EXPECT_NEAR(stray(2).rms_mm, 2, 1e-12);
}

TEST(Figures, AnExtraStrokeCountsByTheNearestOfAll) {
  const InkFigures f =
      compare({{Point(0, 0), Point(9, 0)}, {Point(0, 4), Point(9, 4)}, {Point(0, 3), Point(9, 3)}},
              {{Point(0, 0), Point(9, 0)}, {Point(0, 4), Point(9, 4)}}, Align::none);
  EXPECT_EQ(f.strokes_extra, 1);
  EXPECT_EQ(f.strokes_missing, 0);
  EXPECT_NEAR(f.max_mm, 1, 1e-12);
  EXPECT_EQ(f.stray_mm, 0) << "it is near another one";
  EXPECT_NEAR(f.rms_mm, std::sqrt(1. / 3), 1e-12);
}

TEST(Figures, OfNothingAreZero) {
  const InkFigures f = compare({}, {}, Align::rigid);
  EXPECT_EQ(f.rms_mm, 0);
  EXPECT_EQ(f.max_mm, 0);
  EXPECT_EQ(f.strokes_missing + f.strokes_extra, 0);
  EXPECT_EQ(compare({{}}, {{}}, Align::none).strokes_extra, 0);
}

TEST(Figures, OneStrokeWithACounterpartIsEnoughForAnAlignment) {
  const Drawing reference{{Point(0, 0), Point(40, 0), Point(40, 30)}, {Point(5, 5), Point(9, 9)}};
  Drawing ink{{}, {}};
  const Rigid away{0.3, Point(4, -7)};
  for (const Point& p : reference[0]) ink[0].push_back(away(p));
  const Rigid back = best_alignment(ink, reference);
  EXPECT_NEAR(back.turn, -0.3, 1e-6);
  for (const Point& p : reference[0]) EXPECT_LT((back(away(p)) - p).norm(), 1e-5);
  EXPECT_EQ(best_alignment({{}, {Point(1, 1)}}, {reference[0]}).turn, 0) << "no counterpart";
}

}  // namespace
}  // namespace mrroc::drawing
