#include "tasks/haptic/cell/haptic_cell.hpp"

#include <fmt/core.h>

#include "base/table_config.hpp"
#include "edp/guard.hpp"
#include "robots/catalogue.hpp"
#include "sim/config.hpp"
#include "sim/start_joints.hpp"

namespace mrroc::haptic {
namespace {

constexpr std::size_t kEvery = 20;  // points of the way that are tried: every 0.2 s

[[noreturn]] void refuse(const std::string& what, const std::string& remedy) {
  throw FaultError(FaultCode::bad_configuration, what, remedy);
}

/// Moves the tool of an arm along a way as its inverse kinematics would.
class Reach {
 public:
  Reach(const Config& config, const std::string& key, const sim::ArmParameters& arm)
      : key_(key),
        robot_(robots::read_robot(config, key,
                                  robots::read_type(config, key, robots::catalogue(), arm.type->name))) {
    from_.joints = sim::start_joints(arm);
    from_.motors = robot_->motors_from_joints(from_.joints);
    T_0W_ = robot_->forward(from_.joints);
  }
  /// @param way  of the tool from where it is at the beginning, in the base
  void go(const Vector3& way) {
    const edp::InverseSolution solution = robot_->inverse({T_0W_.R, T_0W_.p + way}, from_.joints);
    const std::string where =
        fmt::format("the hand leads {} by ({:.3f}, {:.3f}, {:.3f}) m: ", key_, way.x(), way.y(), way.z());
    const char* remedy = "make operator.circle smaller, or task.motion_scale nearer to 1";
    if (!solution.reached) refuse(where + "the tool does not reach that", remedy);
    const edp::AxisPositions to{solution.joints, robot_->motors_from_joints(solution.joints)};
    if (const auto fault = edp::check_range(*robot_, from_, to, 0)) refuse(where + describe(*fault), remedy);
    from_ = to;
  }

 private:
  std::string key_;
  std::unique_ptr<const edp::Robot> robot_;
  edp::AxisPositions from_;
  Pose T_0W_;
};

}  // namespace

Scene read_scene(const Config& config) {
  const sim::WorldParameters world = sim::read_world(config);
  const sim::ArmParameters &master = world.arms.at(kMaster), &slave = world.arms.at(kSlave);
  if (slave.plate.shape == sim::PlateShape::none)
    refuse("robots.arm2.plate is missing: the slave would meet nothing",
           "give it a shape, such as robots.arm2.plate.shape=rectangle");
  const sim::HandParameters& hand = master.hand;
  return {.T_0P = master.paper.T_0P,
          .height = slave.start_height,
          .side = slave.plate.distance - slave.plate.width / 2 - slave.pen_radius,
          .top = slave.plate.thickness,
          .depth = slave.plate.width,
          .stiffness = slave.paper.stiffness,
          .compliance = 1 / hand.stiffness + (hand.mass > 0 ? 1 / hand.grip_stiffness : 0)};
}

Surroundings read_surroundings(const Config& config) {
  const TableDescription table = read_table(config);
  const Config task = config.section("task");
  Surroundings s{.stiffness = table.stiffness, .damping = table.damping_ratio};
  s.hand_stiffness =
      task.number("hand_stiffness", s.hand_stiffness, {50, 5000}, "N/m, believed of a hand with its grip");
  s.hand_damping = task.number("hand_damping", s.hand_damping, {0, 500}, "N s/m, believed of a hand");
  return s;
}

void check_reach(const Config& config, const Scene& scene, const Law& law,
                 const std::vector<mp::WayPoint>& way) {
  const sim::WorldParameters world = sim::read_world(config);
  Reach master(config, "arm1", world.arms.at(kMaster)), slave(config, "arm2", world.arms.at(kSlave));
  const Vector3 start = scene.T_0P * Vector3(0, 0, scene.height);
  for (std::size_t n = 0; n < way.size(); n += kEvery) {
    master.go(way[n].p - start);
    slave.go(law.motion_scale * (way[n].p - start));
  }
}

edp::PairLoop pair_loop(const Surroundings& around, const Law& law) {
  return {.master = {.inertia = law.master.inertia, .mobility = law.master.mobility},
          .slave = {.inertia = law.slave.inertia,
                    .mobility = law.slave.mobility,
                    .contact_damping = around.damping},
          .hand_stiffness = around.hand_stiffness,
          .hand_damping = around.hand_damping,
          .motion_scale = law.motion_scale,
          .force_scale = law.force_scale,
          .return_rate = law.return_rate,
          .smoothing = law.smoothing,
          .delay = law.channel.delay,
          .n_s = kPacing.n_s};
}

bool grows_gently(const Surroundings& around, const Law& law) {
  return law.passivity.control &&
         !edp::pair_settles(pair_loop(around, law), around.stiffness, lateness(law.channel, law.macrostep));
}

void check_stability(const Surroundings& around, const Law& law) {
  const edp::PairLoop pair = pair_loop(around, law);
  const double alone = edp::stiffness_limit(pair.slave);
  if (around.stiffness >= alone)
    refuse(fmt::format("on a wall of {:.3g} N/m the slave would swing by itself: it bears {:.3g} N/m",
                       around.stiffness, alone),
           "make task.slave_mobility smaller; `ui_cli stability` tells how much");
  if (law.passivity.control) return;
  const double limit = edp::pair_stiffness_limit(pair);
  if (around.stiffness >= limit)
    refuse(
        fmt::format(
            "without passivity control the pair bears a wall of {:.3g} N/m, and there is one of {:.3g} N/m",
            limit, around.stiffness),
        "leave task.passivity on, or see `ui_cli stability --pair`");
}

}  // namespace mrroc::haptic
