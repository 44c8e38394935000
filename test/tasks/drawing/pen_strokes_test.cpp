// Pen states against the truth of the ink, and against the height of the pen.
#include "tasks/drawing/pen_strokes.hpp"

#include <gtest/gtest.h>

#include "tasks/drawing/doubtful.hpp"
#include "tasks/drawing/results.hpp"

namespace mrroc::drawing {
namespace {

using enum PenState;

/// Ink of a line at 20 mm/s along x from x = 0. @param begin, end [s]
void draw(Ink& ink, int stroke, double begin, double end, double x = 0) {
  for (int k = 0; begin + 0.002 * k <= end; ++k) ink.push_back({stroke, begin + 0.002 * k, x + 0.04 * k, 0});
}

Ink two_strokes() {
  Ink ink;
  draw(ink, 0, 1, 2);
  draw(ink, 1, 4, 5);
  return ink;
}

TEST(WrongStrokes, NoneWhenEveryStrokeHasItsTime) {
  EXPECT_EQ(wrong_strokes(two_strokes(), {{1, 2}, {4, 5}}), 0);
  EXPECT_EQ(wrong_strokes(two_strokes(), {{0.5, 2.3}, {3.9, 5.2}}), 0);
  EXPECT_EQ(wrong_strokes({}, {}), 0);
}

TEST(WrongStrokes, CountsEachThatIsLostSplitSharedOrMadeUp) {
  EXPECT_EQ(wrong_strokes(two_strokes(), {{1, 2}}), 1) << "lost";
  EXPECT_EQ(wrong_strokes(two_strokes(), {}), 2);
  EXPECT_EQ(wrong_strokes(two_strokes(), {{1, 1.5}, {1.6, 2}, {4, 5}}), 1) << "split";
  EXPECT_EQ(wrong_strokes(two_strokes(), {{1, 5}}), 2) << "shared";
  EXPECT_EQ(wrong_strokes(two_strokes(), {{1, 2}, {2.5, 3}, {4, 5}}), 1) << "made up";
  EXPECT_EQ(wrong_strokes({}, {{1, 2}}), 1);
}

TEST(WrongStrokes, AnEndThatIsMissingCountsFromOneAndAHalfMillimetresOn) {
  EXPECT_EQ(wrong_strokes(two_strokes(), {{1.06, 1.94}, {4, 5}}), 0);  // 1.2 mm each
  EXPECT_EQ(wrong_strokes(two_strokes(), {{1.1, 2}, {4, 5}}), 1);      // 2 mm
  EXPECT_EQ(wrong_strokes(two_strokes(), {{1, 2}, {4, 4.9}}), 1);
}

TEST(PaperTimes, AreTheRunsOfNodesOnThePaper) {
  Recording r(0.02);
  std::vector<double> t;
  for (const PenState pen : {paper_surface, paper_surface, lift_off, above_paper, lowering, paper_surface}) {
    r = r.appended({{}, pen});
    t.push_back(10 + 0.02 * static_cast<double>(r.size()));
  }
  const auto times = paper_times(r, t);
  ASSERT_EQ(times.size(), 2U);
  EXPECT_DOUBLE_EQ(times[0].begin, 10);
  EXPECT_DOUBLE_EQ(times[0].end, 10.04);
  EXPECT_DOUBLE_EQ(times[1].end, 10.12);
}

TEST(Hops, AreNoStrokesButLiftsAre) {
  Ink ink;
  draw(ink, 0, 1, 1.5);
  draw(ink, 1, 1.7, 2, 14);  // a hop
  draw(ink, 2, 4, 5);        // a lift
  draw(ink, 3, 5.3, 6, 20);
  const Ink joined = without_hops(ink);
  ASSERT_EQ(joined.size(), ink.size());
  std::vector<int> numbers;
  for (const InkPoint& p : joined)
    if (numbers.empty() || numbers.back() != p.stroke) numbers.push_back(p.stroke);
  EXPECT_EQ(numbers, (std::vector<int>{0, 1}));
  EXPECT_EQ(without_hops(joined), joined);
}

Recording nodes(std::initializer_list<std::pair<PenState, int>> runs) {
  Recording r(0.02);
  for (const auto& [pen, n] : runs)
    for (int k = 0; k < n; ++k)
      r = r.appended({Twist{{0.01 * static_cast<double>(r.size() + 1), 0, 0, 0, 0, 0}}, pen});
  return r;
}

TEST(FalseTouches, AreTakenBackAndTheFirstOnesAreLeftOut) {
  const Recording fine =
      nodes({{paper_surface, 5}, {lift_off, 1}, {above_paper, 3}, {lowering, 2}, {paper_surface, 4}});
  EXPECT_EQ(without_false_touches(fine), fine);
  const Recording first = without_false_touches(
      nodes({{paper_surface, 3}, {lowering, 2}, {paper_surface, 4}, {lift_off, 1}, {above_paper, 2}}));
  ASSERT_EQ(first.size(), 7U);
  EXPECT_EQ(first[0].pen, paper_surface);
  EXPECT_DOUBLE_EQ(first[0].velocity[Axis::x], 0.06) << "the nodes keep their velocities";
  const Recording later = without_false_touches(
      nodes({{paper_surface, 3}, {lift_off, 1}, {paper_surface, 2}, {lowering, 2}, {paper_surface, 4}}));
  ASSERT_EQ(later.size(), 12U) << "the way between strokes stays";
  EXPECT_EQ(later[4].pen, lowering);
  EXPECT_EQ(later[5].pen, lowering);
  EXPECT_EQ(later[8].pen, paper_surface);
}

TEST(FalseTouches, LeaveTheTimesOfTheNodesThatRemain) {
  RunRecord record;
  const Recording taught = nodes({{paper_surface, 2}, {lowering, 1}, {paper_surface, 3}});
  Recording so_far(0.02);
  for (std::size_t n = 0; n < taught.size(); ++n) {
    so_far = so_far.appended(taught[n]);
    note_nodes(record, so_far, 1 + 0.02 * static_cast<double>(n));
  }
  note_nodes(record, without_false_touches(taught), 9);
  ASSERT_EQ(record.node_t.size(), 3U);
  EXPECT_DOUBLE_EQ(record.node_t[0], 1.06);
}

/// A pen that goes along x on the paper and 10 mm above it, and says so.
class Memory {
 public:
  void run(PenState pen, int n, double vx, double vz = 0) {
    for (int k = 0; k < n; ++k) r = r.appended({Twist{{vx, 0, vz, 0, 0, 0}}, pen});
  }
  /// @param says  of the pen while it draws  @param above  of the pen while it travels
  void stroke(PenState says = paper_surface, PenState above = above_paper) {
    run(says, 100, 0.02);
    run(above_paper, 50, 0, -0.01);
    run(above, 60, 0.03);
    run(above_paper, 50, 0, 0.01);
  }
  Recording r{0.02};
};

TEST(DoubtfulStrokes, NoneWhenStatesFitTheHeight) {
  Memory m;
  for (int k = 0; k < 5; ++k) m.stroke();
  EXPECT_EQ(doubtful_strokes(m.r), 0);
  EXPECT_EQ(doubtful_strokes(Recording(0.02)), 0);
}

TEST(DoubtfulStrokes, AStrokeThatWasTakenForAirAndATravelThatWasTakenForPaper) {
  Memory lost;
  lost.stroke();
  lost.stroke(above_paper);
  lost.stroke();
  EXPECT_EQ(doubtful_strokes(lost.r), 1);
  Memory made_up;
  for (int k = 0; k < 4; ++k) made_up.stroke();
  made_up.stroke(paper_surface, paper_surface);
  EXPECT_GE(doubtful_strokes(made_up.r), 1);
}

TEST(CopyWarning, SpeaksWhenAFigureMisses) {
  std::map<std::string, mp::Figure> figures{{"copy_rms_mm", std::vector{0.1, 0.2}},
                                            {"pen_state_wrong_strokes", std::vector{0.0, 0.0}},
                                            {"doubtful_strokes", 0.0}};
  EXPECT_EQ(copy_warning(figures), "");
  figures["copy_rms_mm"] = std::vector{0.1, 29.0};
  EXPECT_NE(copy_warning(figures).find("copy_rms_mm 29"), std::string::npos);
  figures["copy_rms_mm"] = std::vector{0.1, 0.2};
  figures["doubtful_strokes"] = 1.0;
  EXPECT_NE(copy_warning(figures).find("the memory is doubtful (doubtful_strokes 1)"), std::string::npos);
  EXPECT_EQ(copy_warning(figures).find("copies"), std::string::npos) << "they are as taught";
  figures["strokes_extra"] = std::vector{1.0, 0.0};
  const std::string both = copy_warning(figures);
  EXPECT_NE(both.find("the copies are not what was taught (strokes_extra 1)"), std::string::npos) << both;
  EXPECT_NE(both.find("the memory is doubtful (doubtful_strokes 1)"), std::string::npos) << both;
}

}  // namespace
}  // namespace mrroc::drawing
