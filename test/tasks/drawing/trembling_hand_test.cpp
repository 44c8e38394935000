// The whole task with hands that tremble as hands do, at the corners of the ranges that it has to manage.
#include <gtest/gtest.h>

#include "test/tasks/drawing/driven_drawing.hpp"

namespace mrroc::test {
namespace {

void expect_zero(const mp::Figure& figure, const char* key) {
  for (const double x : std::get<std::vector<double>>(figure)) EXPECT_EQ(x, 0) << key;
}

void draw(DrivenDrawing d, double tremor, double frequency, double hand, double paper) {
  SCOPED_TRACE(testing::Message() << "tremor " << tremor << " m at " << frequency << " Hz, hand " << hand
                                  << ", paper " << paper << " N/m");
  d.hand.tremor = tremor;
  d.hand.tremor_frequency = frequency;
  d.hand.stiffness = hand;
  d.paper.stiffness = paper;
  d.drawing = {{{-15, -10}, {15, -10}}, {{-15, 10}, {0, 18}, {15, 10}}};
  const DrivenResult r = run(d);
  ASSERT_EQ(r.outcome, Outcome::terminated) << r.fault.text.view();
  const auto f = drawing::figures_of(d.drawing, true, r.record, r.ink, {}, true);
  EXPECT_EQ(std::get<double>(f.at("strokes_taught")), 2);
  EXPECT_EQ(std::get<double>(f.at("doubtful_strokes")), 0);
  for (const char* key :
       {"pen_state_wrong_strokes", "pen_state_mismatches", "strokes_missing", "strokes_extra"})
    expect_zero(f.at(key), key);
  for (const double rms : std::get<std::vector<double>>(f.at("copy_rms_mm"))) EXPECT_LE(rms, 0.5);
  EXPECT_EQ(drawing::copy_warning(f), "");
}

TEST(TremblingHand, IsCopiedAtAllCornersOfTheRanges) {
  for (const double tremor : {5e-5, 1e-3})
    for (const double frequency : {4., 12.})
      for (const double hand : {300., 2000.})
        for (const double paper : {1e3, 1e5}) draw({}, tremor, frequency, hand, paper);
}

TEST(TremblingHand, IsCopiedWithTheUsualHandAndPaper) {
  for (const double tremor : {1e-4, 3e-4, 1e-3}) draw({}, tremor, 8, 1000, 1e4);
}

TEST(TremblingHand, AWrongPenStateIsNeverDoneWithoutAWord) {
  DrivenDrawing d;
  d.sensor.lift_height = 0.02;  // of a sensor that never sees a lift-off
  d.drawing = {{{-15, -10}, {15, -10}}, {{-15, 10}, {15, 10}}};
  const DrivenResult r = run(d);
  ASSERT_EQ(r.outcome, Outcome::terminated);
  const auto f = drawing::figures_of(d.drawing, true, r.record, r.ink, {}, true);
  EXPECT_NE(drawing::copy_warning(f), "");
}

}  // namespace
}  // namespace mrroc::test
