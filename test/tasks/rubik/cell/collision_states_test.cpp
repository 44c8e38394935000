// The collision check over random states of the usual cell against solids of its own: the distances that its header
// promises, between boxes and prisms that are compared along axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/collision.hpp"
#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"

namespace mrroc::rubik {
namespace {

constexpr double kLinkSkin = 0.010, kHandSkin = 0.001;  // half of the distances that are kept [m]
constexpr int kCube = 2, kSurroundings = 3, kView = 4;  // owners beside the arms

/// A convex solid in the world.
struct Solid {
  std::string name;
  int owner{}, place{};  // in the chain of the arm, 0: base
  bool hand{};
  std::vector<Vector3> corners{}, normals{}, edges{};
  Vector3 middle = Vector3::Zero();
  double radius{};
  double uncertain{5e-4};  // how far its surface may be from the true one [m]
};

/// @return how far apart two solids are at least [m]; negative: how deep they are in each other
double gap(const Solid& a, const Solid& b) {
  double most = (a.middle - b.middle).norm() - a.radius - b.radius;
  if (most > 0) return most;
  const auto look = [&](const Vector3& axis) {
    const double length = axis.norm();
    if (length < 1e-9) return;
    const auto range = [&](const Solid& s) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Vector3& c : s.corners) {
        low = std::min(low, axis.dot(c) / length);
        high = std::max(high, axis.dot(c) / length);
      }
      return std::pair(low, high);
    };
    const auto [low_a, high_a] = range(a);
    const auto [low_b, high_b] = range(b);
    most = std::max({most, low_a - high_b, low_b - high_a});
  };
  for (const Solid* const s : {&a, &b})
    for (const Vector3& n : s->normals) look(n);
  for (const Vector3& i : a.edges)
    for (const Vector3& j : b.edges) look(i.cross(j));
  return most;
}

Solid placed(Solid s, const Pose& T_U) {
  for (Vector3& c : s.corners) c = T_U * c;
  for (auto* const directions : {&s.normals, &s.edges})
    for (Vector3& d : *directions) d = T_U.R * d;
  for (const Vector3& c : s.corners) s.middle += c / static_cast<double>(s.corners.size());
  for (const Vector3& c : s.corners) s.radius = std::max(s.radius, (c - s.middle).norm());
  return s;
}

Solid box(Solid s, const Vector3& size, double skin, const Pose& T_U) {
  const Vector3 half = size / 2 + Vector3::Constant(skin);
  for (const double x : {-1., 1.})
    for (const double y : {-1., 1.})
      for (const double z : {-1., 1.}) s.corners.emplace_back(half.cwiseProduct(Vector3(x, y, z)));
  s.normals = s.edges = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
  return placed(s, T_U);
}

/// A cylinder along z, as a prism whose sides it touches.
Solid prism(Solid s, const Vector3& size, double skin, const Pose& T_U) {
  constexpr int kSides = 24;
  s.uncertain = 0.002;
  const double half = size.z() / 2 + skin;
  const double radius = (size.x() / 2 + skin) / std::cos(std::numbers::pi / kSides);
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    for (const double z : {-half, half})
      s.corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    const double side = angle + std::numbers::pi / kSides;
    s.normals.emplace_back(std::cos(side), std::sin(side), 0);
    s.edges.emplace_back(-std::sin(side), std::cos(side), 0);
  }
  s.normals.emplace_back(Vector3::UnitZ());
  s.edges.emplace_back(Vector3::UnitZ());
  return placed(s, T_U);
}

/// What the camera sees of a face, from the lens down to just above the stickers.
Solid pyramid(const Viewing& viewing) {
  Solid s{"view", kView};
  constexpr double kAbove = 0.004;
  const Vector3 top(0, 0, viewing.distance);
  s.normals = {Vector3::UnitZ()};
  s.edges = {Vector3::UnitX(), Vector3::UnitY()};
  s.corners = {top};
  const std::array<std::pair<int, int>, 4> around{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (const auto& [x, y] : around) s.corners.emplace_back(x * kEdge / 2, y * kEdge / 2, kAbove);
  for (std::size_t k = 1; k <= 4; ++k) {
    const Vector3 down = s.corners[k] - top;
    s.edges.push_back(down);
    s.normals.push_back(down.cross(s.corners[k % 4 + 1] - top));
  }
  return placed(s, viewing.T_UV);
}

class CollisionStates : public testing::Test {
 protected:
  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  /// @param spread  of joints around the meeting [rad], [m]
  CellState any(double spread) {
    CellState s{cell_.meeting().joints, {}, {}, false, false};
    for (const Hand hand : kHands) {
      for (double& q : s.joints[index(hand)]) q += between(-spread, spread);
      s.jaws[index(hand)] = between(0.05, kOpenJaws);
    }
    s.grasp = {between(0, 1) < 0.5 ? Hand::track : Hand::postument, Face::D, Face::B};
    s.touched = between(0, 1) < 0.3;
    s.looked_at = between(0, 1) < 0.3;
    return s;
  }

  [[nodiscard]] std::vector<Solid> solids(const CellState& state) {
    std::vector<Solid> all{pyramid(viewing_)};
    constexpr double kCamera = 0.08;
    all.push_back(box({"camera", kSurroundings}, Vector3::Constant(kCamera), kLinkSkin,
                      viewing_.T_UV * Pose{Matrix3::Identity(), {0, 0, viewing_.distance + kCamera / 2}}));
    all.push_back(box({"floor", kSurroundings}, {10, 10, 1}, 0, {Matrix3::Identity(), {0, 0, -0.5}}));
    for (const Hand hand : kHands) add_arm(hand, state, all);
    const Pose T_UE = cell_.forward(state.grasp.hand, state.joints[index(state.grasp.hand)]);
    all.push_back(
        box({"cube", kCube, 0, true}, Vector3::Constant(kEdge), kHandSkin, T_UE * cube_in_hand(state.grasp)));
    return all;
  }

  void add_arm(Hand hand, const CellState& state, std::vector<Solid>& all) {
    constexpr double kTable = 0.05, kFlange = 0.105;
    const int owner = static_cast<int>(index(hand));
    const ArmBelief& belief = belief_.arms[index(hand)];
    all.push_back(box({"table", kSurroundings}, {0.6, 0.6, kTable}, kLinkSkin,
                      belief.T_UB * belief_.T_0P * Pose{Matrix3::Identity(), {0, 0, -kTable / 2}}));
    const std::string prefix = std::string(belief.type->name) + ' ';
    sim::LinkChain& chain = chains_[index(hand)];
    chain.set_joints(state.joints[index(hand)]);
    for (std::size_t n = 0; n < chain.solids().size(); ++n) {
      const sim::LinkSolid& s = chain.solids()[n];
      const auto make = s.shape == Shape::cylinder ? prism : box;
      ASSERT_NE(s.shape, Shape::sphere) << "not made here";
      all.push_back(make({prefix + s.link, owner, s.place}, s.size, kLinkSkin, chain.place(n)));
    }
    const GripperShape& g = belief.gripper;
    const double length = belief.type->driver.T_WE.p.z() - kFlange;
    const int place = chain.joints() + 1;
    const Pose T_UE = cell_.forward(hand, state.joints[index(hand)]);
    all.push_back(box({prefix + "palm", owner, place, true}, {g.palm_width, g.palm_width, length - g.palm},
                      kHandSkin, T_UE * Pose{Matrix3::Identity(), {0, 0, -(length + g.palm) / 2}}));
    for (const double side : {-1., 1.}) {
      const double y = side * (state.jaws[index(hand)] + g.pad_thickness) / 2;
      all.push_back(box({prefix + "finger", owner, place, true},
                        {g.pad_width, g.pad_thickness, length + g.pad_depth / 2}, kHandSkin,
                        T_UE * Pose{Matrix3::Identity(), {0, y, (g.pad_depth / 2 - length) / 2}}));
    }
  }

  /// @return whether two solids must keep apart in this state
  [[nodiscard]] bool matter(const Solid& a, const Solid& b, const CellState& state) const {
    const auto stands = [](const Solid& s) {
      return s.owner == kSurroundings || (s.owner < kCube && s.place == 0);
    };
    if (a.owner == kView || b.owner == kView) {
      const Solid& other = a.owner == kView ? b : a;
      return state.looked_at && other.owner < kCube;
    }
    if (stands(a) && stands(b)) return false;
    if (a.owner == b.owner) return a.owner < kCube && std::abs(a.place - b.place) >= 3;
    for (const auto& [arm, other] : {std::pair(&a, &b), {&b, &a}}) {
      // Carriage and column stand on the floor.
      if (other->owner == kSurroundings && arm->owner < kCube && arm->place < 3) return false;
      if (other->owner != kCube) continue;
      const bool holds = arm->owner == static_cast<int>(index(state.grasp.hand));
      const int flange = chains_[index(state.grasp.hand)].joints();
      if (holds && arm->place >= flange) return false;
      if (arm->hand && state.touched) return false;
    }
    return true;
  }

  /// What the cell says of a state is right.
  void expect_right(const CellState& state) {
    const bool free = cell_.is_free(state);
    const std::string told = free ? "" : cell_.touching();
    const std::vector<Solid> all = solids(state);
    bool touches = told.empty();
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = a + 1; b < all.size(); ++b) {
        if (!matter(all[a], all[b], state)) continue;
        const double apart = gap(all[a], all[b]), uncertain = all[a].uncertain + all[b].uncertain;
        const std::string one = all[a].name + " and " + all[b].name;
        if (free) {
          EXPECT_GT(apart, -uncertain) << one;
        }
        const bool named = told == one || told == all[b].name + " and " + all[a].name;
        touches = touches || (named && apart < uncertain);
      }
    EXPECT_TRUE(touches) << told;
    seen_.insert(free ? "free" : told);
  }

  CellBelief belief_ = usual_cell();
  Viewing viewing_ = viewing_place();
  CubePlanCell cell_{belief_, viewing_};
  std::array<sim::LinkChain, 2> chains_{
      sim::LinkChain(*belief_.arms[0].type, belief_.arms[0].model, belief_.arms[0].T_UB),
      sim::LinkChain(*belief_.arms[1].type, belief_.arms[1].model, belief_.arms[1].T_UB)};
  std::set<std::string> seen_;
  std::mt19937 random_{1};
};

TEST_F(CollisionStates, NearTheMeetingAreFreeJustWhenTheSolidsAreApart) {
  for (int k = 0; k < 600; ++k) expect_right(any(0.05));
  EXPECT_GT(seen_.size(), 8U) << "of many kinds";
  EXPECT_TRUE(seen_.contains("free"));
}

TEST_F(CollisionStates, AnywhereAreFreeJustWhenTheSolidsAreApart) {
  for (int k = 0; k < 1500; ++k) expect_right(any(2));
  EXPECT_GT(seen_.size(), 40U) << "of many kinds";
  EXPECT_TRUE(seen_.contains("free"));
}

}  // namespace
}  // namespace mrroc::rubik
