// The real effector driver on one arm of the simulator, for contacts like those of tasks.
#pragma once
#include <array>
#include <functional>
#include <memory>

#include "edp/driver.hpp"
#include "robots/irb6/arm.hpp"
#include "sim/world.hpp"
#include "test/rig/irb6_cell.hpp"

namespace mrroc::sim {

/// The arm on its pedestal, its driver, and nothing else in the cell.
class PressingArm {
 public:
  /// @return the world of one arm with default parameters
  static WorldParameters world_of_one() {
    WorldParameters w = rig::irb6_cell();
    w.arms.resize(1);
    return w;
  }
  /// @return parameters of its driver as the configuration gives them
  static edp::DriverParameters driver_parameters() {
    const irb6::Arm arm(irb6::kPostument);
    edp::DriverParameters p;
    p.T_WE = arm.tool_in_wrist();
    p.force.T_WS = arm.sensor_in_wrist();
    p.force.stuck_after = 25;
    return p;
  }

  explicit PressingArm(const WorldParameters& w = world_of_one(),
                       edp::DriverParameters p = driver_parameters(), std::uint64_t seed = 1,
                       const irb6::ArmParameters& believed = irb6::kPostument)
      : world(w, seed), arm_(believed) {
    p.synchro_joints = world.start_joints(0);
    driver = std::make_unique<edp::Driver>(arm_, p);
  }

  World world;
  std::unique_ptr<edp::Driver> driver;
  std::function<void()> after_each_step;  ///< looks at world and driver

  /// Synchronises, lets the arm come to rest and takes the force without contact as zero.
  void prepare() {
    macrostep(command(Instruction::synchro));
    for (int k = 0; k < kSettle; ++k) move({});
    for (int k = 0; k < kRest; ++k) macrostep({});
    EffectorCommand c = command(Instruction::set);
    c.set = static_cast<std::uint8_t>(Part::robot_model);
    c.robot_model.set_force_tool = true;
    c.robot_model.weight = arm_.parameters().tool_weight;
    c.robot_model.mass_centre = arm_.parameters().tool_mass_centre;
    macrostep(c);
  }

  /// One macrostep of TCIM-VELOCITY. @return its reply
  EffectorReply move(const TaskFrameCommand& frame) {
    EffectorCommand c = command(Instruction::set);
    c.set = static_cast<std::uint8_t>(Part::arm);
    c.arm.frame = frame;
    return macrostep(c);
  }
  /// One silent macrostep. @return its reply
  EffectorReply rest() { return macrostep({}); }

  /// @return force that the pen exerts on the paper, true [N]
  [[nodiscard]] double force() const { return world.truth(0).paper_force; }

 private:
  static constexpr int kSettle = 50;  // macrosteps
  static constexpr int kRest = 30;    // macrosteps

  EffectorCommand command(Instruction instruction) {
    EffectorCommand c;
    c.session = 1;
    c.number = ++number_;
    c.instruction = instruction;
    return c;
  }
  EffectorReply macrostep(const std::optional<EffectorCommand>& c) {
    if (c) driver->take(*c);
    EffectorReply reply{};
    do {
      const HardwareCommand out = driver->step(world.reading(0));
      if (driver->reply_due()) reply = driver->reply();
      world.step({&out, 1});
      if (after_each_step) after_each_step();
    } while (!driver->at_boundary());
    return reply;
  }

  irb6::Arm arm_;
  std::int64_t number_{};
};

}  // namespace mrroc::sim
