#include "edp/platform/record.hpp"

#include <fmt/core.h>

#include <array>
#include <string_view>

namespace mrroc::edp {
namespace {

void put(std::string& text, double number) { text += fmt::format(",{:.9g}", number); }

template <class Numbers>
void put_all(std::string& text, const Numbers& numbers) {
  for (const auto number : numbers) put(text, static_cast<double>(number));
}

}  // namespace

std::string PlatformStepRecord::header() {
  std::string text = "step,t,state,fault,set_x,set_y,set_phi,set_v,set_w,x,y,phi,vx,vy,w";
  constexpr std::array<std::string_view, kWheels> kNames{"fl", "fr", "rl", "rr"};
  const auto wheels = [&](std::string_view what) {
    for (const std::string_view wheel : kNames) text += fmt::format(",{}_{}", what, wheel);
  };
  wheels("enc");
  text += ",yaw,yaw_rate,imu_valid";
  wheels("load");
  wheels("current");
  text += ",enabled";
  wheels("torque");
  return text + "\n";
}

void PlatformStepRecord::append(std::string& text, double dt) const {
  text += fmt::format("{},{:.4f},{},{}", step, static_cast<double>(step) * dt, to_string(state),
                      to_string(fault));
  put_all(text, std::array{wanted.p.x, wanted.p.y, wanted.p.phi, wanted.v, wanted.w});
  put_all(text, std::array{p.x, p.y, p.phi, v.vx, v.vy, v.w});
  put_all(text, encoder);
  put_all(text, std::array{yaw, yaw_rate, imu_valid ? 1. : 0.});
  put_all(text, load);
  put_all(text, current);
  put(text, enabled ? 1 : 0);
  put_all(text, torque);
  text += '\n';
}

PlatformStepRecord record_of(const PlatformDriver& driver, const PlatformReading& reading,
                             const PlatformDrive& command) noexcept {
  PlatformStepRecord r;
  r.step = reading.step;
  r.state = driver.state();
  r.fault = driver.fault().code;
  r.wanted = driver.wanted();
  r.p = driver.estimate().estimate.p;
  r.v = driver.estimate().estimate.v;
  r.encoder = reading.encoder;
  r.yaw = reading.yaw;
  r.yaw_rate = reading.yaw_rate;
  r.imu_valid = reading.imu_valid;
  r.load = reading.load;
  r.current = reading.current;
  r.enabled = command.enabled;
  r.torque = command.torque;
  return r;
}

}  // namespace mrroc::edp
