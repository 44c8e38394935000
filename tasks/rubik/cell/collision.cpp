#include "tasks/rubik/cell/collision.hpp"

#include <cstdlib>
#include <utility>

#include "sim/collision.hpp"

namespace mrroc::rubik {
namespace {

constexpr double kLinkSkin = 0.010;  // [m]
constexpr double kHandSkin = 0.001;  // [m]
constexpr double kFlange = 0.105;    // front of the flange, in W [m]
constexpr double kTableEdge = 0.6;   // [m]
constexpr double kTableThickness = 0.05;
constexpr int kFarJoints = 3;  // nearer links of one arm touch each other by construction

// To which part of the cell a shape belongs.
constexpr int kCube = 2;
constexpr int kSurroundings = 3;
constexpr int kView = 4;
constexpr double kAboveFace = 0.004;  // [m]
constexpr double kCamera = 0.08;      // its housing [m]

struct Item {
  std::string name;
  int owner{};  // an arm, kCube or kSurroundings
  int place{};  // in the chain of the arm, 0: base
  bool hand{};
};

struct ArmShapes {
  sim::LinkChain chain;
  GripperShape gripper;
  std::vector<std::size_t> items;  // of the links
  std::size_t palm{};
  std::array<std::size_t, 2> fingers{};
  double length{};  // from the flange to E [m]
};

}  // namespace

struct CellCollision::Impl {
  Impl(const CellBelief& cell, const std::optional<Viewing>& viewing) {
    for (std::size_t k = 0; k < cell.arms.size(); ++k) add_arm(static_cast<int>(k), cell.arms[k]);
    cube = add_box({"cube", kCube, 0, true}, Vector3::Constant(kEdge), kHandSkin);
    for (const ArmBelief& arm : cell.arms) {
      const std::size_t table =
          add_box({"table", kSurroundings, 0, false}, {kTableEdge, kTableEdge, kTableThickness}, kLinkSkin);
      solids.place(table, arm.T_UB * cell.T_0P * Pose{Matrix3::Identity(), {0, 0, -kTableThickness / 2}});
    }
    solids.place(add_box({"floor", kSurroundings, 0, false}, {10, 10, 1}, 0),
                 {Matrix3::Identity(), {0, 0, -0.5}});
    if (viewing) {
      solids.place(add_box({"camera", kSurroundings, 0, false}, Vector3::Constant(kCamera), kLinkSkin),
                   viewing->T_UV * Pose{Matrix3::Identity(), {0, 0, viewing->distance + kCamera / 2}});
      // The last one, so that it is the second one of every pair.
      items.push_back({"view", kView, 0, false});
      solids.place(add_pyramid(viewing->distance), viewing->T_UV);
    }
    choose_pairs();
  }

  /// The camera's view of a face, from the lens down to just above the stickers.
  std::size_t add_pyramid(double distance) {
    std::vector<Vector3> corners{{0, 0, distance}};
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) corners.emplace_back(x * kEdge, y * kEdge, kAboveFace);
    return solids.add_hull(corners);
  }

  std::size_t add_box(Item item, const Vector3& size, double skin) {
    return add(std::move(item), Shape::box, size, skin);
  }
  std::size_t add(Item item, Shape shape, const Vector3& size, double skin) {
    items.push_back(std::move(item));
    return solids.add(shape, size + Vector3::Constant(2 * skin));
  }

  void add_arm(int number, const ArmBelief& belief) {
    ArmShapes arm{sim::LinkChain(*belief.type, belief.model, belief.T_UB), belief.gripper, {}, {}, {}, {}};
    const std::string prefix = std::string(belief.type->name) + ' ';
    for (const sim::LinkSolid& s : arm.chain.solids())
      arm.items.push_back(add({prefix + s.link, number, s.place, false}, s.shape, s.size, kLinkSkin));
    // From the flange to the cube.
    const GripperShape& g = arm.gripper;
    const int hand = arm.chain.joints() + 1;
    arm.length = belief.type->driver.T_WE.p.z() - kFlange;
    arm.palm = add_box({prefix + "palm", number, hand, true},
                       {g.palm_width, g.palm_width, arm.length - g.palm}, kHandSkin);
    for (std::size_t& finger : arm.fingers)
      finger = add_box({prefix + "finger", number, hand, true},
                       {g.pad_width, g.pad_thickness, arm.length + g.pad_depth / 2}, kHandSkin);
    arms.push_back(std::move(arm));
  }

  void choose_pairs() {
    for (std::size_t a = 0; a < items.size(); ++a)
      for (std::size_t b = a + 1; b < items.size(); ++b) {
        const Item &i = items[a], &j = items[b];
        const bool fixed = (i.owner == kSurroundings || (i.owner < kCube && i.place == 0)) &&
                           (j.owner == kSurroundings || (j.owner < kCube && j.place == 0));
        const bool near = i.owner == j.owner && std::abs(i.place - j.place) < kFarJoints;
        // Carriage and column stand on the floor.
        const bool standing = (i.owner < kCube && i.place < kFarJoints && j.owner == kSurroundings) ||
                              (j.owner < kCube && j.place < kFarJoints && i.owner == kSurroundings);
        const bool seen = j.owner == kView && (i.owner == kCube || i.owner == kSurroundings);
        if (!fixed && !near && !standing && !seen) pairs.emplace_back(a, b);
      }
  }

  void place(const CellState& state) {
    for (std::size_t k = 0; k < arms.size(); ++k) {
      ArmShapes& arm = arms[k];
      arm.chain.set_joints(state.joints[k]);
      for (std::size_t n = 0; n < arm.items.size(); ++n) solids.place(arm.items[n], arm.chain.place(n));
      const Pose T_UE = arm.chain.T_UE();
      const GripperShape& g = arm.gripper;
      solids.place(arm.palm, T_UE * Pose{Matrix3::Identity(), {0, 0, -(arm.length + g.palm) / 2}});
      for (const int side : {0, 1}) {
        const double y = (side == 0 ? 1 : -1) * (state.jaws[k] + g.pad_thickness) / 2;
        solids.place(arm.fingers[static_cast<std::size_t>(side)],
                     T_UE * Pose{Matrix3::Identity(), {0, y, (g.pad_depth / 2 - arm.length) / 2}});
      }
      if (k == index(state.grasp.hand)) solids.place(cube, T_UE * cube_in_hand(state.grasp));
    }
    solids.find_bounds();
  }

  /// @return whether what grips or may touch the cube is allowed to
  [[nodiscard]] bool may_touch_cube(const Item& it, const CellState& state) const {
    // The flange of the hand that holds it is as far as it is.
    const int carrier = static_cast<int>(index(state.grasp.hand));
    const bool holds = it.owner == carrier &&
                       it.place + kFarJoints > arms[static_cast<std::size_t>(carrier)].chain.joints() + 2;
    return holds || (it.hand && state.touched);
  }

  bool is_free(const CellState& state) {
    place(state);
    for (const auto& [a, b] : pairs) {
      const Item &i = items[a], &j = items[b];
      if (j.owner == kView && !state.looked_at) continue;
      if ((i.owner == kCube || j.owner == kCube) && may_touch_cube(i.owner == kCube ? j : i, state)) continue;
      if (!solids.touch(a, b)) continue;
      touching = {i.name, j.name};
      return false;
    }
    return true;
  }

  sim::CollisionSolids solids;  // by number as items
  std::vector<Item> items;
  std::vector<ArmShapes> arms;
  std::size_t cube{};
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::array<std::string, 2> touching;
};

CellCollision::CellCollision(const CellBelief& cell, const std::optional<Viewing>& viewing)
    : impl_(std::make_unique<Impl>(cell, viewing)) {}
CellCollision::~CellCollision() = default;
bool CellCollision::is_free(const CellState& state) { return impl_->is_free(state); }
const std::array<std::string, 2>& CellCollision::touching() const { return impl_->touching; }

}  // namespace mrroc::rubik
