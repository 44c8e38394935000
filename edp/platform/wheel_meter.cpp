#include "edp/platform/wheel_meter.hpp"

#include <algorithm>
#include <numbers>

namespace mrroc::edp {
namespace {

/// @return weights of equally spaced readings, the oldest first, whose sum is the slope per step of the least-squares parabola
///         at the newest
constexpr std::array<double, WheelMeter::kReadings> slope_weights() {
  constexpr auto kN = static_cast<int>(WheelMeter::kReadings);
  constexpr double kMiddle = (kN - 1) / 2.;
  double squares = 0;
  for (int k = 0; k < kN; ++k) squares += (k - kMiddle) * (k - kMiddle);
  const auto curve = [&](int k) { return (k - kMiddle) * (k - kMiddle) - squares / kN; };
  double curves = 0;
  for (int k = 0; k < kN; ++k) curves += curve(k) * curve(k);
  std::array<double, WheelMeter::kReadings> weights{};
  for (int k = 0; k < kN; ++k)
    weights[static_cast<std::size_t>(k)] = (k - kMiddle) / squares + 2 * kMiddle * curve(k) / curves;
  return weights;
}
constexpr std::array<double, WheelMeter::kReadings> kSlope = slope_weights();

}  // namespace

WheelMeter::WheelMeter(double increments_per_turn, double dt) noexcept
    : rad_per_increment_(2 * std::numbers::pi / increments_per_turn), dt_(dt) {}

void WheelMeter::add(const PerWheel& count) noexcept {
  newest_ = (newest_ + 1) % kReadings;
  ring_[newest_] = count;
}

void WheelMeter::step(const PlatformReading& reading) noexcept {
  if (step_ < 0) {
    encoder_ = reading.encoder;
    step_ = reading.step - 1;
    PerWheel count{};
    std::ranges::copy(reading.encoder, count.begin());
    ring_.fill(count);
  }
  const PerWheel before = ring_[newest_];
  for (std::size_t k = 0; k < kWheels; ++k)
    increments_[k] = static_cast<std::int32_t>(static_cast<std::uint32_t>(reading.encoder[k]) -
                                               static_cast<std::uint32_t>(encoder_[k]));
  const std::int64_t steps = std::max<std::int64_t>(reading.step - step_, 1);
  for (std::int64_t k = std::max<std::int64_t>(steps - static_cast<std::int64_t>(kReadings), 0) + 1;
       k <= steps; ++k) {
    PerWheel count = before;
    for (std::size_t w = 0; w < kWheels; ++w)
      count[w] += increments_[w] * static_cast<double>(k) / static_cast<double>(steps);
    add(count);
  }
  encoder_ = reading.encoder;
  step_ = reading.step;
}

PerWheel WheelMeter::turned(std::size_t steps) const noexcept {
  const PerWheel& before = ring_[(newest_ + kReadings - steps) % kReadings];
  PerWheel turned{};
  for (std::size_t k = 0; k < kWheels; ++k) turned[k] = ring_[newest_][k] - before[k];
  return turned;
}

PerWheel WheelMeter::theta() const noexcept {
  PerWheel theta = ring_[newest_];
  for (double& turned : theta) turned *= rad_per_increment_;
  return theta;
}

PerWheel WheelMeter::theta_dot() const noexcept {
  PerWheel speed{};
  for (std::size_t k = 0; k < kReadings; ++k) {
    const PerWheel& count = ring_[(newest_ + 1 + k) % kReadings];  // from the oldest
    for (std::size_t w = 0; w < kWheels; ++w) speed[w] += kSlope[k] * (count[w] - ring_[newest_][w]);
  }
  for (double& turns : speed) turns *= rad_per_increment_ / dt_;
  return speed;
}

}  // namespace mrroc::edp
