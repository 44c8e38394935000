// Shell of a virtual sensor that aggregates an effector driver's own readings.
#pragma once
#include <concepts>
#include <string>

#include "base/link/process.hpp"
#include "base/link/transmission_link.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/finite.hpp"
#include "mrroc/sensor_reading_t.hpp"
#include "mrroc/step_samples_t.hpp"

namespace mrroc::vsp {

/// Messages with samples that are kept: of three of the longest macrosteps.
inline constexpr std::int64_t kSampleMessages = 3 * 32;

/// Interface of a sensor's kernel.
template <class S>
concept StepSensor = requires(S s, const StepSample& sample) {
  s.step(sample);
  { s.reading() } -> std::same_as<SensorReading>;
};

/// A sensor whose kernel takes what the agent tells it, MS (12), (13). It gets the setting of each macrostep before the
/// samples of that macrostep; numbers are finite, what they mean is for the kernel to check.
template <class S>
concept SettableSensor = StepSensor<S> && requires(S s, const SensorSetting& setting) {
  s.set(setting);
};

/// Runs a virtual sensor until its effector driver or the system ends: takes the steps of each macrostep,
/// publishes one reading with the same stamp. With the wall clock it goes on with what is there when it has missed
/// some.
/// @param process  this process's connection
/// @param robot    whose samples it reads: channel "ROBOT.samples"
/// @param channel  where it publishes, e.g. "arm1.pen_state"; settings y_cV come by "arm1.pen_state.setting", one for every
///                 macrostep (rule R1), until their agent has ended
template <StepSensor S>
void run_step_sensor(link::Process& process, const std::string& robot, const std::string& channel, S sensor) {
  const auto samples = process.inbox<step_samples_t, kSampleMessages>(robot + ".samples");
  link::IncomingLink<SensorSetting> settings(process, channel + ".setting");
  const link::Sources sources{samples.get(), &settings.inbox()};
  const auto set_until_now = [&](std::int64_t i) {
    return settings.here(i) || (process.over() && i > process.stop_as_of());
  };
  const auto readings = process.outbox<sensor_reading_t>(channel);
  if (!process.assemble()) return;
  for (std::int64_t number = 1;; ++number) {
    const step_samples_t* m{};
    process.await_from(sources, FaultCode::peer_silent, [&] {
      m = process.lock_step() ? samples->at(number) : samples->next(number);
      if (m && process.lock_step() && !set_until_now(m->macrostep)) m = nullptr;
      return m || process.phase() == link::Phase::finished;
    });
    if (!m) break;
    process.report_skipped(m->header.stamp - number);
    number = m->header.stamp;
    settings.receive(m->macrostep);
    if constexpr (SettableSensor<S>) sensor.set(settings.image().value);
    for (int k = 0; k < m->n && k < static_cast<int>(std::size(m->sample)); ++k)
      if (finite(m->sample[k])) sensor.step(from_message(m->sample[k]));
    if (m->more) continue;
    // After a stop drivers send samples until the supervisor knows that all rest.
    if (process.over() && m->macrostep > process.stop_as_of()) process.seal_fingerprints();
    readings->publish(to_message(sensor.reading()), m->macrostep);
    process.report_progress(m->macrostep, m->step);
    if (m->last) break;
  }
  process.report_done();
  process.stay();
}

}  // namespace mrroc::vsp
