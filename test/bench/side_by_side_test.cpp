// Work that is done several pieces at a time: all of it, in its order, and no more at a time than asked for.
#include "bench/side_by_side.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace mrroc::test {
namespace {

using namespace std::chrono_literals;
using bench::side_by_side;

TEST(SideBySide, GivesEachResultInItsPlaceAndTellsHowFarItIs) {
  std::vector<std::size_t> told;
  const auto results = side_by_side<int>(
      20, 3, [](std::size_t k) { return static_cast<int>(k * k); },
      [&](std::size_t done) { told.push_back(done); });
  ASSERT_EQ(results.size(), 20U);
  for (std::size_t k = 0; k < 20; ++k) EXPECT_EQ(results[k], static_cast<int>(k * k));
  ASSERT_EQ(told.size(), 20U);
  for (std::size_t k = 0; k < 20; ++k) EXPECT_EQ(told[k], k + 1);
}

/// @return the most pieces that were under way together
int most_at_a_time(std::size_t at_a_time) {
  std::atomic<int> now = 0, most = 0;
  side_by_side<int>(
      8, at_a_time,
      [&](std::size_t) {
        const int n = ++now;
        for (int m = most; n > m && !most.compare_exchange_weak(m, n);) continue;
        std::this_thread::sleep_for(30ms);
        --now;
        return 0;
      },
      [](std::size_t) {});
  return most;
}

TEST(SideBySide, WorksOnAsManyPiecesAtATimeAsAskedFor) {
  EXPECT_EQ(most_at_a_time(1), 1);
  EXPECT_EQ(most_at_a_time(2), 2);
}

TEST(SideBySide, NothingIsDoneOfNothing) {
  const auto results = side_by_side<int>(
      0, 2, [](std::size_t) { return 1; }, [](std::size_t) {});
  EXPECT_TRUE(results.empty());
}

TEST(SideBySide, AFailureEndsItAndIsPassedOn) {
  std::atomic<int> begun = 0;
  const auto work = [&](std::size_t k) {
    ++begun;
    if (k == 2) throw std::runtime_error("the third");
    return 0;
  };
  try {
    side_by_side<int>(1000, 1, work, [](std::size_t) {});
    ADD_FAILURE() << "the third piece fails";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "the third");
  }
  EXPECT_EQ(begun, 3) << "nothing is begun after a failure";
}

}  // namespace
}  // namespace mrroc::test
