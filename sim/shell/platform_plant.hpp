// The platforms of the simulation, for the simulator's shell.
#pragma once
#include <memory>
#include <vector>

#include "edp/platform/record.hpp"
#include "edp/recorder.hpp"
#include "mrroc/box_truth_t.hpp"
#include "mrroc/motion_capture_t.hpp"
#include "mrroc/platform_truth_t.hpp"
#include "sim/platform/platform_world.hpp"
#include "sim/shell/plant.hpp"
#include "sim/shell/quick_stop.hpp"
#include "sim/shell/shell.hpp"

namespace mrroc::sim {

/// Publishes hardware_state and truth of every platform, truth of every box, and motion_capture of both when a reading of it
/// becomes visible.
class PlatformPlant final : public DrivenPlant<PlatformEffector> {
 public:
  /// @param process, world  outlive this object
  PlatformPlant(link::Process& process, PlatformWorld& world, const ShellParameters& parameters);

  void publish(std::int64_t step, std::int64_t macrostep, bool begins) override;
  void publish_rest(std::int64_t macrostep) override;
  void brake(std::size_t robot) override { quick_stops_[robot].brake(drives()[robot]); }
  [[nodiscard]] std::span<const std::int32_t> encoders(std::size_t robot) const override;
  void record(std::int64_t step, bool dump) override;
  void dump_on_abort() override;
  void step() override { world_.step(drives()); }

 private:
  using Records = edp::BasicRecordFiles<edp::OwnFormat<edp::PlatformStepRecord>>;

  [[nodiscard]] bool obeyable(const platform_drive_t& command) const override { return is_proper(command); }

  PlatformWorld& world_;
  std::vector<QuickStop> quick_stops_;
  std::vector<std::unique_ptr<link::Outbox<motion_capture_t>>> capture_out_;
  std::vector<std::unique_ptr<link::Outbox<platform_truth_t>>> truth_out_;
  std::vector<std::unique_ptr<link::Outbox<motion_capture_t>>> box_capture_out_;
  std::vector<std::unique_ptr<link::Outbox<box_truth_t>>> box_truth_out_;
  std::vector<std::unique_ptr<Records>> records_;
};

}  // namespace mrroc::sim
