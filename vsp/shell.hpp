// Shell of a virtual sensor that aggregates an effector driver's own readings.
#pragma once
#include <concepts>
#include <string>

#include "base/link/process.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/finite.hpp"
#include "mrroc/sensor_reading_t.hpp"
#include "mrroc/step_samples_t.hpp"

namespace mrroc::vsp {

/// What a sensor's kernel provides.
template <class S>
concept StepSensor = requires(S s, const StepSample& sample) {
  s.step(sample);
  { s.reading() } -> std::same_as<SensorReading>;
};

/// Runs a virtual sensor until its effector driver or the system ends: takes the steps of each macrostep,
/// publishes one reading with the same stamp. With the wall clock it goes on with what is there when it has missed
/// some.
/// @param process  this process's connection
/// @param robot    whose samples it reads: channel "ROBOT.samples"
/// @param channel  where it publishes, e.g. "arm1.pen_state"
template <StepSensor S>
void run_step_sensor(link::Process& process, const std::string& robot, const std::string& channel, S sensor) {
  const auto samples = process.inbox<step_samples_t>(robot + ".samples");
  const link::Sources sources{samples.get()};
  const auto readings = process.outbox<sensor_reading_t>(channel);
  if (!process.assemble()) return;
  for (std::int64_t i = 1;; ++i) {
    const step_samples_t* m{};
    process.await_from(sources, FaultCode::peer_silent, [&] {
      m = process.lock_step() ? samples->at(i) : samples->next(i);
      return m || process.phase() == link::Phase::finished;
    });
    if (!m) break;
    process.report_skipped(m->header.stamp - i);
    i = m->header.stamp;
    for (int k = 0; k < m->n && k < static_cast<int>(std::size(m->sample)); ++k)
      if (finite(m->sample[k])) sensor.step(from_message(m->sample[k]));
    readings->publish(to_message(sensor.reading()), i);
    process.report_progress(i, 0);
    if (m->last) break;
  }
  process.report_done();
  process.stay();
}

}  // namespace mrroc::vsp
