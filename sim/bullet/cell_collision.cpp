#include "sim/bullet/cell_collision.hpp"

#include <btBulletCollisionCommon.h>

#include <stdexcept>
#include <string>

#include "robots/irb6/arm.hpp"
#include "sim/bullet/convert.hpp"
#include "sim/bullet/multibody.hpp"
#include "sim/robot_description.hpp"

namespace mrroc::sim {
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
  std::unique_ptr<btConvexShape> shape;
  btCollisionObject object;
};

struct Contact final : btCollisionWorld::ContactResultCallback {
  bool touching{};
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    touching = touching || point.getDistance() <= 0;
    return 0;
  }
};

struct ArmShapes {
  Pose T_UB;
  ArmBody body;
  GripperBodyParameters gripper;
  std::vector<BodyShape> links;
  std::vector<std::size_t> items;  // of the links
  std::size_t palm{};
  std::array<std::size_t, 2> fingers{};
};

}  // namespace

struct CellCollision::Impl {
  Impl(const WorldParameters& world, const std::optional<rubik::Viewing>& viewing) {
    if (world.arms.size() != 2 || world.arms[0].model != ArmModel::irb6_postument ||
        world.arms[1].model != ArmModel::irb6_track)
      throw std::invalid_argument("collisions: the arms are not the postument's and the track's");
    for (std::size_t k = 0; k < 2; ++k) add_arm(static_cast<int>(k), world.arms[k]);
    const double edge = world.cube ? world.cube->edge : kCubeEdge;
    cube = add("cube", kCube, 0, true, box(Vector3::Constant(edge), kHandSkin));
    for (const ArmParameters& arm : world.arms) {
      const std::size_t table =
          add("table", kSurroundings, 0, false, box({kTableEdge, kTableEdge, kTableThickness}, kLinkSkin));
      place(table, arm.T_UB * arm.paper.T_0P * Pose{Matrix3::Identity(), {0, 0, -kTableThickness / 2}});
    }
    const std::size_t floor = add("floor", kSurroundings, 0, false, box({10, 10, 1}, 0));
    place(floor, {Matrix3::Identity(), {0, 0, -0.5}});
    if (viewing) {
      place(add("camera", kSurroundings, 0, false, box(Vector3::Constant(kCamera), kLinkSkin)),
            viewing->T_UV * Pose{Matrix3::Identity(), {0, 0, viewing->distance + kCamera / 2}});
      // The last one, so that it is the second one of every pair.
      place(add("view", kView, 0, false, pyramid(viewing->distance, edge)), viewing->T_UV);
    }
    choose_pairs();
  }

  /// What the camera sees of a face, from the lens down to just above the stickers.
  static std::unique_ptr<btConvexShape> pyramid(double distance, double edge) {
    auto hull = std::make_unique<btConvexHullShape>();
    hull->setMargin(0);
    hull->addPoint({0, 0, distance}, false);
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) hull->addPoint({x * edge, y * edge, kAboveFace}, false);
    hull->recalcLocalAabb();
    return hull;
  }

  static std::unique_ptr<btConvexShape> box(const Vector3& size, double skin) {
    const Vector3 half = size / 2 + Vector3::Constant(skin);
    return std::make_unique<btBoxShape>(to_bullet(half));
  }
  static std::unique_ptr<btConvexShape> solid(const BodyShape& s) {
    const Vector3 half = s.size / 2 + Vector3::Constant(kLinkSkin);
    if (s.shape == camera::Shape::cylinder) return std::make_unique<btCylinderShapeZ>(to_bullet(half));
    if (s.shape == camera::Shape::sphere) return std::make_unique<btSphereShape>(half.x());
    return std::make_unique<btBoxShape>(to_bullet(half));
  }

  std::size_t add(const std::string& name, int owner, int where, bool hand,
                  std::unique_ptr<btConvexShape> shape) {
    auto item = std::make_unique<Item>();
    item->name = name;
    item->owner = owner;
    item->place = where;
    item->hand = hand;
    item->shape = std::move(shape);
    item->object.setCollisionShape(item->shape.get());
    items.push_back(std::move(item));
    return items.size() - 1;
  }

  void add_arm(int number, const ArmParameters& p) {
    if (!p.gripper) throw std::invalid_argument("collisions: an arm has no gripper");
    const auto robot = irb6::make_arm(robot_name(p.model), irb6::model_number(p.kinematics));
    ArmShapes arm;
    arm.T_UB = p.T_UB;
    arm.gripper = *p.gripper;
    arm.body = build_arm(robot_description(p.model), &robot->parameters().lengths, p.T_UB,
                         AxisVector::Zero(robot->axes()), {}, p.gripper);
    const std::string prefix = std::string(robot_name(p.model)) + ' ';
    for (const BodyShape& s : arm.body.shapes) {
      if (s.body >= arm.body.tool) continue;  // the pen's holder
      arm.links.push_back(s);
      arm.items.push_back(add(prefix + s.link, number, s.body + 1, false, solid(s)));
    }
    // From the flange to the cube.
    const GripperBodyParameters& g = arm.gripper;
    const int hand = arm.body.joints + 1;
    const double length = robot->tool_in_wrist().p.z() - kFlange;
    arm.palm = add(prefix + "palm", number, hand, true,
                   box({g.palm_width, g.palm_width, length - g.palm}, kHandSkin));
    for (std::size_t& finger : arm.fingers)
      finger = add(prefix + "finger", number, hand, true,
                   box({g.pad_width, g.pad_thickness, length + g.pad_depth / 2}, kHandSkin));
    lengths[static_cast<std::size_t>(number)] = length;
    arms.push_back(std::move(arm));
  }

  void choose_pairs() {
    for (std::size_t a = 0; a < items.size(); ++a)
      for (std::size_t b = a + 1; b < items.size(); ++b) {
        const Item &i = *items[a], &j = *items[b];
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

  void place(std::size_t item, const Pose& T_U) { items[item]->object.setWorldTransform(to_bullet(T_U)); }

  void place(const rubik::CellState& state) {
    for (std::size_t k = 0; k < 2; ++k) {
      ArmShapes& arm = arms[k];
      set_joints(*arm.body.body, state.joints[k]);
      for (std::size_t n = 0; n < arm.links.size(); ++n) {
        const BodyShape& s = arm.links[n];
        place(arm.items[n], (s.body < 0 ? arm.T_UB : link_pose(*arm.body.body, s.body)) * s.T_GV);
      }
      const Pose T_UE = link_pose(*arm.body.body, arm.body.tool) * arm.body.T_GE;
      const GripperBodyParameters& g = arm.gripper;
      place(arm.palm, T_UE * Pose{Matrix3::Identity(), {0, 0, -(lengths[k] + g.palm) / 2}});
      for (const int side : {0, 1}) {
        const double y = (side == 0 ? 1 : -1) * (state.jaws[k] + g.pad_thickness) / 2;
        place(arm.fingers[static_cast<std::size_t>(side)],
              T_UE * Pose{Matrix3::Identity(), {0, y, (g.pad_depth / 2 - lengths[k]) / 2}});
      }
      if (k == rubik::index(state.grasp.hand)) place(cube, T_UE * rubik::cube_in_hand(state.grasp));
    }
  }

  bool is_free(const rubik::CellState& state) {
    place(state);
    const int carrier = static_cast<int>(rubik::index(state.grasp.hand));
    for (const auto& item : items)
      item->shape->getAabb(item->object.getWorldTransform(), low[index_of(item)], high[index_of(item)]);
    for (const auto& [a, b] : pairs) {
      if (!TestAabbAgainstAabb2(low[a], high[a], low[b], high[b])) continue;
      const Item &i = *items[a], &j = *items[b];
      if (j.owner == kView && !state.looked_at) continue;
      if (i.owner == kCube || j.owner == kCube) {
        const Item& it = i.owner == kCube ? j : i;
        // The flange of the hand that holds it is as far as it is.
        if (it.owner == carrier &&
            it.place + kFarJoints > arms[static_cast<std::size_t>(carrier)].body.joints + 2)
          continue;
        if (it.hand && state.touched) continue;
      }
      Contact contact;
      detection.contactPairTest(&items[a]->object, &items[b]->object, contact);
      if (contact.touching) {
        touching = {i.name, j.name};
        return false;
      }
    }
    return true;
  }
  [[nodiscard]] std::size_t index_of(const std::unique_ptr<Item>& item) const {
    return static_cast<std::size_t>(&item - items.data());
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld detection{&dispatcher, &broadphase, &configuration};
  std::vector<std::unique_ptr<Item>> items;
  std::vector<ArmShapes> arms;
  std::array<double, 2> lengths{};  // from the flange to E [m]
  std::size_t cube{};
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::array<btVector3, 64> low, high;
  std::array<std::string, 2> touching;
};

CellCollision::CellCollision(const WorldParameters& world, const std::optional<rubik::Viewing>& viewing)
    : impl_(std::make_unique<Impl>(world, viewing)) {}
CellCollision::~CellCollision() = default;
bool CellCollision::is_free(const rubik::CellState& state) { return impl_->is_free(state); }
const std::array<std::string, 2>& CellCollision::touching() const { return impl_->touching; }

}  // namespace mrroc::sim
