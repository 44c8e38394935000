#include "sim/shell/arm_plant.hpp"

#include <algorithm>
#include <cmath>

#include "base/cube/facelets.hpp"
#include "base/msg/pose_rows.hpp"

namespace mrroc::sim {

ArmPlant::ArmPlant(link::Process& process, World& world, const ShellParameters& parameters)
    : DrivenPlant(parameters.drivers), world_(world) {
  if (world_.cube()) cube_out_ = process.outbox<cube_truth_t>("cube.truth");
  if (world_.free_body()) free_body_out_ = process.outbox<free_body_truth_t>("free_body.truth");
  for (const std::string& robot : parameters.robots)
    records_.push_back(std::make_unique<edp::RecordFiles>(recording_in(parameters.folder), parameters.folder,
                                                          "simulator-" + robot, kMaxAxes, kStep));
  connect(process, parameters.robots);
}

void ArmPlant::publish(std::int64_t step, std::int64_t macrostep, bool begins) {
  for (std::size_t arm = 0; arm < robots(); ++arm)
    publish_reading(arm, world_.reading(static_cast<int>(arm)), step, macrostep);
  if (cube_out_ && begins) publish_cube(macrostep);
  if (free_body_out_ && begins) publish_free_body(macrostep);
}

void ArmPlant::publish_cube(std::int64_t i) {
  const CubeTruth& cube = *world_.cube();
  cube_truth_t m{};
  put_rows(m.T_UC, cube.T_UC);
  for (int arm = 0; arm < std::min(world_.arms(), 2); ++arm) {
    const Vector3 middle = world_.effector(arm).inverse() * cube.T_UC.p;
    std::ranges::copy(middle, m.in_hand[arm]);
  }
  std::ranges::copy(cube::to_facelets(cube.state), m.facelets);
  m.axis = cube.axis;
  std::ranges::copy(cube.angle, m.angle);
  std::ranges::copy(cube.torque, m.torque);
  m.squeeze = cube.squeeze;
  m.on_floor = cube.on_floor;
  cube_out_->publish(m, i);
}

void ArmPlant::publish_free_body(std::int64_t i) {
  const FreeBodyTruth& body = *world_.free_body();
  free_body_truth_t m{};
  put_rows(m.T_UO, body.T_UO);
  std::ranges::copy(body.velocity, m.velocity);
  std::ranges::copy(body.press, m.press);
  m.on_pedestal = body.on_pedestal;
  m.on_floor = body.on_floor;
  free_body_out_->publish(m, i);
}

bool ArmPlant::obeyable(const hardware_command_t& command) const {
  return std::ranges::all_of(command.pwm, [](double pwm) { return std::isfinite(pwm); });
}

void ArmPlant::brake(std::size_t robot) { drives()[robot].enabled = drives()[robot].jaws_enabled = false; }

std::span<const std::int32_t> ArmPlant::encoders(std::size_t robot) const {
  return world_.reading(static_cast<int>(robot)).encoder;
}

void ArmPlant::record(std::int64_t step, bool dump) {
  for (std::size_t arm = 0; arm < records_.size(); ++arm) {
    const HardwareReading& reading = world_.reading(static_cast<int>(arm));
    edp::StepRecord r;
    r.step = step;
    r.encoder = reading.encoder;
    r.current = reading.current;
    r.pwm = drives()[arm].pwm;
    r.S_F_m = reading.S_F_m;
    if (dump) records_[arm]->trigger();
    records_[arm]->add(r);
  }
}

void ArmPlant::dump_on_abort() {
  for (const auto& record : records_) record->dump_on_abort();
}

}  // namespace mrroc::sim
