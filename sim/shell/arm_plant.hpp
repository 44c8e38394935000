// The arms of the simulation and their cube, for the simulator's shell.
#pragma once
#include <memory>
#include <vector>

#include "edp/step_record.hpp"
#include "mrroc/cube_truth_t.hpp"
#include "mrroc/free_body_truth_t.hpp"
#include "sim/shell/plant.hpp"
#include "sim/shell/shell.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// Publishes hardware_state of every arm, cube.truth if there is a cube, and free_body.truth if there is a free body.
class ArmPlant final : public DrivenPlant<ArmEffector> {
 public:
  /// @param process, world  outlive this object
  ArmPlant(link::Process& process, World& world, const ShellParameters& parameters);

  void publish(std::int64_t step, std::int64_t macrostep, bool begins) override;
  void brake(std::size_t robot) override;
  [[nodiscard]] std::span<const std::int32_t> encoders(std::size_t robot) const override;
  void record(std::int64_t step, bool dump) override;
  void dump_on_abort() override;
  void step() override { world_.step(drives()); }

 private:
  [[nodiscard]] bool obeyable(const hardware_command_t& command) const override;
  void publish_cube(std::int64_t i);
  void publish_free_body(std::int64_t i);

  World& world_;
  std::unique_ptr<link::Outbox<cube_truth_t>> cube_out_;            // none: there is no cube
  std::unique_ptr<link::Outbox<free_body_truth_t>> free_body_out_;  // none: there is no free body
  std::vector<std::unique_ptr<edp::RecordFiles>> records_;
};

}  // namespace mrroc::sim
