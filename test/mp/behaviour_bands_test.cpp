#include "mp/behaviour_bands.hpp"

#include <gtest/gtest.h>

#include <string>

namespace mrroc::mp {
namespace {

ArmTrace rows(const std::vector<int>& m) {
  ArmTrace trace(m.size());
  for (std::size_t k = 0; k < m.size(); ++k) {
    trace[k].t = 0.5 * static_cast<double>(k);
    trace[k].m = m[k];
  }
  return trace;
}

TEST(BehaviourBands, AreTheStretchesOfOneBehaviour) {
  const auto bands =
      behaviour_bands(rows({0, 1, 1, 2, 0, 2}), [](int m) { return m == 1 ? "approach" : "hold"; });
  ASSERT_EQ(bands.size(), 3U);
  EXPECT_EQ(bands[0].name, "approach");
  EXPECT_EQ(bands[0].from, 0.5);
  EXPECT_EQ(bands[0].to, 1.5);
  EXPECT_EQ(bands[1].m, 2);
  EXPECT_EQ(bands[1].to, 2);
  EXPECT_EQ(bands[2].from, 2.5) << "none while there is no behaviour";
}

TEST(BehaviourBands, ARunHasATimeAlsoWithoutRows) {
  EXPECT_EQ(times_of({}), (std::pair{0.0, 1.0}));
  EXPECT_EQ(times_of({rows({1, 1, 1}), rows({0, 0, 0, 0, 0})}), (std::pair{0.0, 2.0}));
}

TEST(BehaviourBands, AShortRunHasASecondFromItsBeginning) {
  ArmTrace one = rows({1});
  one[0].t = 2.5;
  EXPECT_EQ(times_of({one}), (std::pair{2.5, 3.5}));
  EXPECT_EQ(times_of({rows({1, 1, 1})}), (std::pair{0.0, 1.0})) << "just as long";
  ArmTrace later = rows({1, 1, 1, 1});
  for (ArmRow& row : later) row.t += 1;
  EXPECT_EQ(times_of({later}), (std::pair{1.0, 2.5}));
}

TEST(BehaviourBands, ABehaviourThatComesAgainHasABandOfItsOwn) {
  const auto bands = behaviour_bands(rows({3, 3, 0, 0, 3}), [](int m) { return std::to_string(m); });
  ASSERT_EQ(bands.size(), 2U);
  EXPECT_EQ(bands[0].name, "3");
  EXPECT_EQ(bands[0].from, 0);
  EXPECT_EQ(bands[0].to, 1);
  EXPECT_EQ(bands[1].from, 2);
  EXPECT_EQ(bands[1].to, 2);
  EXPECT_TRUE(behaviour_bands({}, [](int) { return ""; }).empty());
}

}  // namespace
}  // namespace mrroc::mp
