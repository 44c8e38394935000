// What touches what in many states of the usual cell, by numbers: they change only when somebody means them to.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>

#include "base/hash.hpp"
#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"

namespace mrroc::rubik {
namespace {

/// The same numbers everywhere.
class Numbers {
 public:
  double between(double a, double b) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return a + (b - a) * static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_{1};
};

class CollisionStates : public testing::Test {
 protected:
  using Counts = std::map<std::string, int>;

  CellState any(double spread) {
    CellState s{cell_.meeting().joints, {}, {}, false, false};
    for (const Hand hand : kHands) {
      for (double& q : s.joints[index(hand)]) q += numbers_.between(-spread, spread);
      s.jaws[index(hand)] = numbers_.between(0.05, kOpenJaws);
    }
    s.grasp = {numbers_.between(0, 1) < 0.5 ? Hand::track : Hand::postument, Face::D, Face::B};
    s.touched = numbers_.between(0, 1) < 0.3;
    s.looked_at = numbers_.between(0, 1) < 0.3;
    return s;
  }
  void count(const CellState& state, Counts& counts) const {
    ++counts[cell_.is_free(state) ? "free" : cell_.touching()];
  }

  CubePlanCell cell_{usual_cell(), viewing_place()};
  Numbers numbers_;
};

TEST_F(CollisionStates, NearTheMeeting) {
  Counts counts;
  for (int k = 0; k < 4000; ++k) count(any(0.05), counts);
  EXPECT_EQ(counts, (Counts{{"free", 1551},
                            {"irb6_postument finger and cube", 178},
                            {"irb6_postument finger and irb6_track finger", 362},
                            {"irb6_postument finger and irb6_track palm", 4},
                            {"irb6_postument finger and view", 160},
                            {"irb6_postument palm and cube", 174},
                            {"irb6_postument palm and irb6_track finger", 343},
                            {"irb6_postument palm and irb6_track palm", 53},
                            {"irb6_postument palm and view", 297},
                            {"irb6_postument wrist and cube", 4},
                            {"irb6_postument wrist and irb6_track finger", 1},
                            {"irb6_postument wrist and view", 482},
                            {"irb6_track finger and cube", 308},
                            {"irb6_track finger and view", 34},
                            {"irb6_track palm and cube", 45},
                            {"irb6_track palm and view", 2},
                            {"irb6_track wrist and cube", 2}}));
}

// What touches what is in the message when it is not as it was.
TEST_F(CollisionStates, Anywhere) {
  Counts counts;
  for (int k = 0; k < 20000; ++k) count(any(2), counts);
  Hash hash;
  std::string all;
  for (const auto& [what, n] : counts) {
    hash.add(what);
    hash.add(static_cast<std::uint64_t>(n));
    all += what + ": " + std::to_string(n) + '\n';
  }
  EXPECT_EQ(hash.value(), 9833956777780397447U) << all;
  EXPECT_EQ(counts["free"], 5569);
}

}  // namespace
}  // namespace mrroc::rubik
