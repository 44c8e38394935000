#include "edp/step_record.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "edp/recorder_impl.hpp"

namespace mrroc::edp {
namespace {

std::array<double, 3> three(const Vector3& p) { return {p.x(), p.y(), p.z()}; }

template <class Numbers>
void put(std::string& text, const Numbers& numbers, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) text += fmt::format(",{:.9g}", static_cast<double>(numbers[k]));
}

}  // namespace

StepRecord record_of(const Driver& driver, const HardwareReading& reading,
                     const HardwareCommand& command) noexcept {
  StepRecord r;
  r.step = reading.step;
  r.state = driver.state();
  r.fault = driver.fault().code;
  const SetPoint& set = driver.set_point();
  std::copy_n(set.axes.motors.data(), set.axes.motors.size(), r.set_motor.begin());
  r.encoder = reading.encoder;
  r.current = reading.current;
  r.pwm = command.pwm;
  r.set_position = three(set.T_0E.p);
  if (const auto samples = driver.samples(); !samples.empty()) {
    r.position = three(samples.back().T_0E.p);
    r.F_a = samples.back().F_a;
  }
  r.S_F_m = reading.S_F_m;
  return r;
}

std::string StepFormat::header() const {
  std::string text = "step,t,state,fault";
  for (const std::string_view name : {"set_m", "enc", "current", "pwm"})
    for (int k = 1; k <= axes_; ++k) text += fmt::format(",{}{}", name, k);
  return text + ",set_x,set_y,set_z,x,y,z,Fx,Fy,Fz,Nx,Ny,Nz,raw_Fx,raw_Fy,raw_Fz,raw_Nx,raw_Ny,raw_Nz\n";
}

void StepFormat::append(std::string& text, const StepRecord& record, double dt) const {
  const auto n = static_cast<std::size_t>(axes_);
  text += fmt::format("{},{:.4f},{},{}", record.step, static_cast<double>(record.step) * dt,
                      to_string(record.state), to_string(record.fault));
  put(text, record.set_motor, n);
  put(text, record.encoder, n);
  put(text, record.current, n);
  put(text, record.pwm, n);
  put(text, record.set_position, 3);
  put(text, record.position, 3);
  put(text, record.F_a.v, 6);
  put(text, record.S_F_m.v, 6);
  text += '\n';
}

template class BasicRecordFiles<StepFormat>;

}  // namespace mrroc::edp
