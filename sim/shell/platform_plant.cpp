#include "sim/shell/platform_plant.hpp"

namespace mrroc::sim {

PlatformPlant::PlatformPlant(link::Process& process, PlatformWorld& world, const ShellParameters& parameters)
    : DrivenPlant(parameters.platform_drivers), world_(world) {
  for (const std::string& key : parameters.platforms) {
    records_.push_back(std::make_unique<Records>(recording_in(parameters.folder), parameters.folder,
                                                 "simulator-" + key,
                                                 edp::OwnFormat<edp::PlatformStepRecord>{}, kPlatformStep));
    quick_stops_.emplace_back(world.body(static_cast<int>(quick_stops_.size())));
    capture_out_.push_back(process.outbox<motion_capture_t>(key + ".motion_capture"));
    truth_out_.push_back(process.outbox<platform_truth_t>(key + ".truth"));
  }
  for (const std::string& name : parameters.boxes) {
    box_capture_out_.push_back(process.outbox<motion_capture_t>(name + ".motion_capture"));
    box_truth_out_.push_back(process.outbox<box_truth_t>(name + ".truth"));
  }
  connect(process, parameters.platforms);
}

void PlatformPlant::publish(std::int64_t step, std::int64_t macrostep, bool begins) {
  for (std::size_t k = 0; k < robots(); ++k) {
    const int platform = static_cast<int>(k);
    quick_stops_[k].measure(world_.reading(platform));
    publish_reading(k, world_.reading(platform), step, macrostep);
    if (const auto& captured = world_.motion_capture(platform))
      capture_out_[k]->publish(to_message(captured->reading), captured->number);
    if (begins) truth_out_[k]->publish(to_message(world_.truth(platform)), macrostep);
  }
  for (std::size_t k = 0; k < box_truth_out_.size(); ++k) {
    const int box = static_cast<int>(k);
    if (const auto& captured = world_.box_motion_capture(box))
      box_capture_out_[k]->publish(to_message(captured->reading), captured->number);
    if (begins) box_truth_out_[k]->publish(to_message(world_.box_truth(box)), macrostep);
  }
}

void PlatformPlant::publish_rest(std::int64_t macrostep) {
  for (std::size_t k = 0; k < robots(); ++k)
    truth_out_[k]->publish(to_message(world_.truth(static_cast<int>(k))), macrostep);
}

std::span<const std::int32_t> PlatformPlant::encoders(std::size_t robot) const {
  return world_.reading(static_cast<int>(robot)).encoder;
}

void PlatformPlant::record(std::int64_t step, bool dump) {
  for (std::size_t k = 0; k < records_.size(); ++k) {
    const PlatformReading& reading = world_.reading(static_cast<int>(k));
    edp::PlatformStepRecord r;
    r.step = step;
    r.encoder = reading.encoder;
    r.yaw = reading.yaw;
    r.yaw_rate = reading.yaw_rate;
    r.imu_valid = reading.imu_valid;
    r.load = reading.load;
    r.current = reading.current;
    r.enabled = drives()[k].enabled;
    r.torque = drives()[k].torque;
    if (dump) records_[k]->trigger();
    records_[k]->add(r);
  }
}

void PlatformPlant::dump_on_abort() {
  for (const auto& record : records_) record->dump_on_abort();
}

}  // namespace mrroc::sim
