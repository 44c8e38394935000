#include "base/counted.hpp"

#include <gtest/gtest.h>

namespace mrroc {
namespace {

TEST(Counted, OneThingIsNotSeveral) {
  EXPECT_EQ(counted(1, "stroke"), "1 stroke");
  EXPECT_EQ(counted(0, "stroke"), "0 strokes");
  EXPECT_EQ(counted(std::size_t{2}, "stroke"), "2 strokes");
  EXPECT_EQ(counted(2, "stripe of ink", "stripes of ink"), "2 stripes of ink");
}

}  // namespace
}  // namespace mrroc
