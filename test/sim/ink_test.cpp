#include <gtest/gtest.h>

#include "sim/paper.hpp"

namespace mrroc::sim {
namespace {

const PaperParameters kPaper;

// Pen at a place of the sheet [m], touching with 1 N or free.
void put(Ink& ink, double x, double y, double z, bool touching) {
  ink.step(kPaper.T_0P * Vector3(x, y, z), touching ? 1 : 0, 0);
}

TEST(Ink, IsOnlyWhereThePenTouches) {
  Ink ink(kPaper);
  put(ink, 0, 0, 0.01, false);
  put(ink, 0.01, 0, 1e-5, false);
  EXPECT_TRUE(ink.points().empty());
  put(ink, 0.02, 0.03, -1e-4, true);
  ASSERT_EQ(ink.points().size(), 1U);
  EXPECT_NEAR(ink.points()[0].x, 20, 1e-9);
  EXPECT_NEAR(ink.points()[0].y, 30, 1e-9);
}

TEST(Ink, SheetLiesUprightForSomeoneBehindTheArm) {
  const Vector3 right = kPaper.T_0P.R.col(0);
  const Vector3 up = kPaper.T_0P.R.col(1);
  EXPECT_EQ(right, Vector3(0, -1, 0));
  EXPECT_EQ(up, Vector3(1, 0, 0));
  EXPECT_EQ(kPaper.T_0P.R.col(2), Vector3(0, 0, 1));
}

TEST(Ink, ABounceDoesNotBeginANewStrokeButALiftDoes) {
  Ink ink(kPaper);
  put(ink, 0, 0, -1e-4, true);
  put(ink, 0, 0, 0.9e-3, false);
  put(ink, 0, 0, -1e-4, true);
  put(ink, 0, 0, 1.1e-3, false);
  put(ink, 0, 0, -1e-4, true);
  ASSERT_EQ(ink.points().size(), 3U);
  EXPECT_EQ(ink.points()[0].stroke, 0);
  EXPECT_EQ(ink.points()[1].stroke, 0);
  EXPECT_EQ(ink.points()[2].stroke, 1);
}

TEST(Ink, NoneBesideTheSheet) {
  Ink ink(kPaper);
  put(ink, 0.151, 0, -1e-4, true);
  EXPECT_TRUE(ink.points().empty());
}

TEST(Ink, ANewSheetIsClean) {
  Ink ink(kPaper);
  put(ink, 0, 0, -1e-4, true);
  ink.clear();
  EXPECT_TRUE(ink.points().empty());
  put(ink, 0, 0, -1e-4, true);
  EXPECT_EQ(ink.points()[0].stroke, 0);
}

}  // namespace
}  // namespace mrroc::sim
