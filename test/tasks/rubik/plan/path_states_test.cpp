// The states that are checked on a path, the speed of E along it, and which of several paths is taken.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "ecp/generators/polyline.hpp"
#include "ecp/generators/trajectory.hpp"
#include "tasks/rubik/plan/paths.hpp"

namespace mrroc::rubik {
namespace {

constexpr double kGear = 100;
constexpr double kLinear = 0.4, kAngular = 0.5;  // most of E [m/s], [rad/s]

/// Arms whose joints are where E is: x y z, then angle times axis; the track arm has a track along x before them. Motors
/// do not follow joints evenly. Writes down the states that it is asked for.
class Written : public PlanCell {
 public:
  Written() {
    for (const Hand hand : kHands) {
      const int axes = hand == Hand::track ? 7 : 6;
      limits_[index(hand)] = {
          {AxisVector::Constant(axes, 50), AxisVector::Constant(axes, 200)}, kLinear, kAngular};
    }
  }
  [[nodiscard]] const Meeting& meeting() const override { return meeting_; }
  [[nodiscard]] const Viewing* viewing() const override { return nullptr; }
  [[nodiscard]] const SpeedLimits& limits(Hand hand) const override { return limits_[index(hand)]; }
  [[nodiscard]] AxisVector motors(Hand, const AxisVector& q) const override {
    return kGear * q.unaryExpr([](double x) { return std::sinh(x); });
  }
  [[nodiscard]] AxisVector joints(Hand, const AxisVector& m) const override {
    return (m / kGear).unaryExpr([](double x) { return std::asinh(x); });
  }
  [[nodiscard]] Pose forward(Hand hand, const AxisVector& q) const override {
    Vector3 p = q.segment<3>(hand == Hand::track ? 1 : 0);
    if (hand == Hand::track) p.x() += q[0];
    return {rotation_from_angle_axis(q.tail<3>()), p};
  }
  [[nodiscard]] std::optional<AxisVector> inverse(Hand hand, const Pose& T_UE,
                                                  const AxisVector& near) const override {
    AxisVector q = near;
    q.segment<3>(hand == Hand::track ? 1 : 0) = T_UE.p;
    if (hand == Hand::track) q[1] -= near[0];
    q.tail<3>() = angle_axis_from_rotation(T_UE.R);
    return q;
  }
  [[nodiscard]] double joint_limit_margin(Hand, const AxisVector& q) const override {
    return 1.5 - q.cwiseAbs().maxCoeff();
  }
  [[nodiscard]] double manipulability(Hand, const AxisVector&) const override { return 1; }
  [[nodiscard]] bool is_free(const CellState& state) const override {
    states.push_back(state);
    return true;
  }
  mutable std::vector<CellState> states;

 private:
  Meeting meeting_;
  std::array<SpeedLimits, 2> limits_;
};

class PathStates : public testing::Test {
 protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  AxisVector any(Hand hand, double most) {
    AxisVector q(hand == Hand::track ? 7 : 6);
    for (double& x : q) x = uniform(-most, most);
    return q;
  }
  std::mt19937 random_{4};
};

// How far the farthest point that a joint moves is from its axis: 1.4 m at the shoulder, 0.1 m at the last one.
TEST_F(PathStates, OfOneArmAreACentimetreApartOrLessAtTheFarthestPointThatAJointMoves) {
  const std::array<double, 7> farthest{1.0, 1.4, 1.4, 1.0, 0.4, 0.4, 0.1};
  for (int run = 0; run < 60; ++run) {
    const Hand hand = run % 2 == 0 ? Hand::track : Hand::postument;
    const AxisVector from = any(hand, 0.4);
    AxisVector to = from;
    double metres = 0;
    for (Eigen::Index k = 0; k < to.size(); ++k) {
      if (run < 42 && k != run / 2 % to.size()) continue;
      to[k] += uniform(-0.4, 0.4);
      const auto joint = static_cast<std::size_t>(k + (7 - to.size()));
      metres = std::max(metres, farthest[joint] * std::abs(to[k] - from[k]));
    }
    const Written cell;
    CellState state{{any(Hand::postument, 1), any(Hand::track, 1)}, {0.01, 0.02}, {}, true, true};
    EXPECT_TRUE(Paths(cell).is_free(hand, from, to, state));
    const auto parts = static_cast<std::size_t>(std::ceil(metres / 0.01));
    const AxisVector begin = cell.motors(hand, from), way = cell.motors(hand, to) - begin;
    std::vector<double> shares;
    for (const CellState& s : cell.states) {
      const double share = (cell.motors(hand, s.joints[index(hand)]) - begin).dot(way) / way.squaredNorm();
      shares.push_back(share);
      EXPECT_LT((cell.motors(hand, s.joints[index(hand)]) - begin - share * way).norm(), 1e-9) << "a line";
      EXPECT_EQ(s.joints[index(other(hand))], state.joints[index(other(hand))]);
      EXPECT_EQ(s.jaws, state.jaws);
      EXPECT_TRUE(s.touched && s.looked_at);
    }
    std::ranges::sort(shares);
    const auto same = [](double a, double b) { return std::abs(a - b) < 1e-9; };
    shares.erase(std::unique(shares.begin(), shares.end(), same), shares.end());
    ASSERT_EQ(shares.size(), parts + 1) << run;
    for (std::size_t k = 0; k <= parts; ++k)
      EXPECT_NEAR(shares[k], static_cast<double>(k) / static_cast<double>(parts), 1e-9);
  }
}

TEST_F(PathStates, OfAPathWithoutLengthAreThatOneState) {
  const Written cell;
  const AxisVector q = any(Hand::track, 1);
  CellState state;
  state.joints = {any(Hand::postument, 1), any(Hand::track, 1)};
  EXPECT_TRUE(Paths(cell).is_free(Hand::track, q, q, state));
  ASSERT_FALSE(cell.states.empty());
  for (const CellState& s : cell.states) EXPECT_LT((s.joints[1] - q).norm(), 1e-12);
}

TEST_F(PathStates, AtALimitAreBeyondIt) {
  struct Limited final : Written {
    explicit Limited(double margin) : margin_(margin) {}
    [[nodiscard]] double joint_limit_margin(Hand, const AxisVector&) const override { return margin_; }
    double margin_;
  };
  const AxisVector from = any(Hand::track, 1), to = any(Hand::track, 1);
  const CellState state{{any(Hand::postument, 1), from}, {}, {}, false, false};
  EXPECT_FALSE(Paths(Limited(0)).is_free(Hand::track, from, to, state));
  EXPECT_TRUE(Paths(Limited(1e-9)).is_free(Hand::track, from, to, state));
}

// 0.2 s ahead or behind, half of that, and in time; until the later one has been at its end for as long.
TEST_F(PathStates, OfBothArmsAreThoseOfEveryHundredthOfASecondWithEitherOneAhead) {
  for (int run = 0; run < 6; ++run) {
    const Written cell;
    const std::array hands{run % 2 == 0 ? Hand::track : Hand::postument,
                           run % 2 == 0 ? Hand::postument : Hand::track};
    std::array<FreeMotion, 2> motions;
    std::vector<std::unique_ptr<ecp::Polyline>> curves;
    for (std::size_t n = 0; n < 2; ++n) {
      std::vector<AxisVector> points{any(hands[n], 0.6), any(hands[n], 0.6)};
      if (run > 2) points.push_back(any(hands[n], 0.6));
      motions[n] = {.hand = hands[n], .points = path_through(cell, hands[n], points)};
      std::vector<ecp::ViaPoint> list;
      for (std::size_t k = 1; k < points.size(); ++k)
        list.push_back({motions[n].points[k].motors, motions[n].points[k].speed, 1, k + 1 < points.size()});
      curves.push_back(std::make_unique<ecp::Polyline>(
          motions[n].points[0].motors, list, cell.limits(hands[n]).motors, ecp::Pacing{}.macrostep_s()));
    }
    const double delay = run % 3 == 0 ? 0.0 : 0.503;
    CellState state;
    state.joints = {any(Hand::postument, 1), any(Hand::track, 1)};
    EXPECT_TRUE(Paths(cell).are_free(motions[0], motions[1], delay, state));
    const double end = std::max(curves[0]->duration(), delay + curves[1]->duration()) + 0.2;
    std::size_t n = 0;
    for (int k = 0; k * 0.01 <= end - 1e-9; ++k)
      for (const double ahead : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
        ASSERT_LT(n, cell.states.size()) << run;
        const CellState& s = cell.states[n++];
        const AxisVector first = cell.joints(hands[0], curves[0]->at(k * 0.01 + ahead));
        const AxisVector second = cell.joints(hands[1], curves[1]->at(k * 0.01 - delay));
        ASSERT_LT((s.joints[index(hands[0])] - first).norm(), 1e-7) << run << ' ' << k << ' ' << ahead;
        ASSERT_LT((s.joints[index(hands[1])] - second).norm(), 1e-7) << run << ' ' << k << ' ' << ahead;
      }
    EXPECT_EQ(n, cell.states.size());
  }
}

// Averaged over eighths of the line.
TEST_F(PathStates, AreReachedAsFastAsTheMotorsAndEMayBe) {
  int motors_alone = 0, linear = 0, angular = 0;
  for (int run = 0; run < 300; ++run) {
    const Written cell;
    const Hand hand = run % 2 == 0 ? Hand::track : Hand::postument;
    const AxisVector from = any(hand, 1);
    AxisVector to = from;
    for (Eigen::Index k = 0; k < to.size(); ++k) {
      const bool turns = k >= to.size() - 3;
      to[k] += (run % 5 < 2 && turns) || (run % 5 > 2 && !turns) ? 0 : uniform(-1, 1);
    }
    const std::vector<Waypoint> path = path_through(cell, hand, {from, to});
    ASSERT_EQ(path.size(), 2U);
    EXPECT_EQ(path[0].speed, 1);
    const AxisVector begin = path[0].motors, way = path[1].motors - begin;
    const double seconds = way.cwiseAbs().maxCoeff() / 50 / path[1].speed;
    double most = 0, most_angular = 0;
    for (int k = 0; k < 8; ++k) {
      const Pose a = cell.forward(hand, cell.joints(hand, begin + k / 8.0 * way));
      const Pose b = cell.forward(hand, cell.joints(hand, begin + (k + 1) / 8.0 * way));
      most = std::max(most, (b.p - a.p).norm() / (seconds / 8));
      most_angular =
          std::max(most_angular, angle_axis_from_rotation(a.R.transpose() * b.R).norm() / (seconds / 8));
    }
    EXPECT_LE(path[1].speed, 1);
    EXPECT_LE(most, kLinear * (1 + 1e-9));
    EXPECT_LE(most_angular, kAngular * (1 + 1e-9));
    const double used = std::max({path[1].speed, most / kLinear, most_angular / kAngular});
    EXPECT_NEAR(used, 1, 1e-9) << "slower than it could be";
    ++(path[1].speed == 1 ? motors_alone : most / kLinear > most_angular / kAngular ? linear : angular);
  }
  EXPECT_GT(linear, 20);
  EXPECT_GT(angular, 20);
  EXPECT_GT(motors_alone, 20);
}

/// Something stands in the middle that a hand passes when it is drawn back far enough.
struct Shelf final : Written {
  explicit Shelf(double depth) : depth_(depth) {}
  [[nodiscard]] bool is_free(const CellState& state) const override {
    const Vector3 p = forward(Hand::postument, state.joints[0]).p;
    return std::abs(p.x()) > 0.1 || p.z() < -depth_;
  }
  double depth_;
};

// Each end is drawn back along z of the hand by up to 30 cm.
TEST_F(PathStates, OfThePathTakenAreThoseOfTheQuickestWhoseEndsAreDrawnBack) {
  int found = 0;
  for (int run = 0; run < 40; ++run) {
    const Shelf cell(uniform(0.02, 0.3));
    AxisVector from = any(Hand::postument, 0.2), to = any(Hand::postument, 0.2);
    from[0] = -uniform(0.2, 0.5);
    to[0] = uniform(0.2, 0.5);
    from[2] = to[2] = 0;
    if (run % 4 == 0) from[1] = to[1] = 1.45;  // next to a limit, beyond which nothing is drawn back
    const CellState state{{from, any(Hand::track, 1)}, {}, {}, false, false};
    const Paths paths(cell);
    ASSERT_FALSE(paths.is_free(Hand::postument, from, to, state));
    double least = 1e9;
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        std::vector<AxisVector> points{from};
        for (const auto& [end, by] : {std::pair(from, a), {to, b}}) {
          const AxisVector back = *cell.inverse(
              Hand::postument,
              cell.forward(Hand::postument, end) * Pose{Matrix3::Identity(), {0, 0, -0.1 * by}}, end);
          if (by > 0 && cell.joint_limit_margin(Hand::postument, back) > 0) points.push_back(back);
        }
        points.push_back(to);
        bool free = true;
        for (std::size_t k = 1; k < points.size(); ++k)
          free = free && paths.is_free(Hand::postument, points[k - 1], points[k], state);
        if (free) least = std::min(least, seconds_along(cell, Hand::postument, points));
      }
    if (least > 1e8) continue;
    ++found;
    const auto path = paths.find(Hand::postument, from, to, state);
    ASSERT_TRUE(path) << run;
    EXPECT_EQ(path->front(), from);
    EXPECT_EQ(path->back(), to);
    EXPECT_NEAR(seconds_along(cell, Hand::postument, *path), least, 1e-9) << run;
    for (std::size_t k = 1; k < path->size(); ++k)
      EXPECT_TRUE(paths.is_free(Hand::postument, (*path)[k - 1], (*path)[k], state));
  }
  EXPECT_GT(found, 20);
}

/// Something as wide as an arm stands in the middle, on the side of it on which the line passes.
struct Block final : Written {
  explicit Block(Hand hand) : hand_(hand) {}
  [[nodiscard]] bool is_free(const CellState& state) const override {
    const Vector3 p = forward(hand_, state.joints[index(hand_)]).p;
    return std::abs(p.x()) > 0.15 || std::abs(p.y()) > 0.25;
  }
  Hand hand_;
};

// Around the line, within 1.4 rad of its middle, 0.4 m on the track; almost as quick as the best of many more points.
TEST_F(PathStates, OfThePathPastWhatIsBesideItAreThroughOneGoodPointAroundTheLine) {
  for (const Hand hand : kHands)
    for (int run = 0; run < 3; ++run) {
      const Block cell(hand);
      const bool track = hand == Hand::track;
      AxisVector from = AxisVector::Zero(track ? 7 : 6), to = from;
      from[track ? 1 : 0] = -uniform(0.4, 0.6);
      to[track ? 1 : 0] = uniform(0.4, 0.6);
      const CellState state{{any(Hand::postument, 1), any(Hand::track, 1)}, {}, {}, false, false};
      const Paths paths(cell);
      const auto path = paths.find(hand, from, to, state);
      ASSERT_TRUE(path);
      ASSERT_EQ(path->size(), 3U);
      EXPECT_EQ(path->front(), from);
      EXPECT_EQ(path->back(), to);
      const AxisVector& via = (*path)[1];
      EXPECT_GT(cell.joint_limit_margin(hand, via), 0);
      EXPECT_TRUE(paths.is_free(hand, from, via, state) && paths.is_free(hand, via, to, state));
      const AxisVector off = (via - (from + to) / 2).cwiseAbs();
      for (Eigen::Index k = 0; k < off.size(); ++k) EXPECT_LT(off[k], track && k == 0 ? 0.4 : 1.4) << k;
      double best = seconds_along(cell, hand, *path);
      for (int k = 0; k < 1500; ++k) {
        AxisVector other = (from + to) / 2;
        for (Eigen::Index n = 0; n < other.size(); ++n)
          other[n] += (track && n == 0 ? 0.2 : 0.7) * (uniform(-1, 1) + uniform(-1, 1));
        if (cell.joint_limit_margin(hand, other) <= 0) continue;
        const double seconds = seconds_along(cell, hand, {from, other, to});
        if (seconds < best && paths.is_free(hand, from, other, state) &&
            paths.is_free(hand, other, to, state))
          best = seconds;
      }
      EXPECT_LT(seconds_along(cell, hand, *path), 1.5 * best) << run;
    }
}

}  // namespace
}  // namespace mrroc::rubik
