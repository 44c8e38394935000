// Compares a receptor's readings with those of a reference, and counts of which kind they were.
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "base/camera.hpp"

namespace mrroc::test {

/// Readings by what was seen.
struct ReadingCount {
  int seen{}, ambiguous{}, badly{}, nothing{};

  /// The readings must be the same, bit by bit, apart from frame and step. @param place  of the picture, for the message
  void compare(const CameraReading& is, const CameraReading& would, const std::string& place) {
    ASSERT_EQ(is.seen, would.seen) << place;
    EXPECT_EQ(is.ambiguous, would.ambiguous) << place;
    EXPECT_EQ(is.reprojection_px, would.reprojection_px) << place;
    EXPECT_EQ(is.T_CG.p, would.T_CG.p) << place;
    EXPECT_EQ(is.T_CG.R, would.T_CG.R) << place;
    EXPECT_EQ(is.covariance, would.covariance) << place;
    ++(is.seen ? seen : is.ambiguous ? ambiguous : is.reprojection_px > 0 ? badly : nothing);
  }
  /// Pictures of every kind were among them.
  void expect_all_kinds() const {
    EXPECT_GT(seen, 20);
    EXPECT_GT(ambiguous, 5);
    EXPECT_GT(badly, 3);
    EXPECT_GT(nothing, 5);
  }
};

}  // namespace mrroc::test
