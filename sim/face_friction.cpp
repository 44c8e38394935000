#include "sim/face_friction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc::sim {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;
/// A seated face creeps to the middle of its seat with this time constant [s], not so fast that what holds it jumps.
constexpr double kSettling = 0.05;
/// A face that passes a seat faster than this does not stay in it [rad/s].
constexpr double kSeatingSpeed = 0.5;

}  // namespace

std::array<FaceFriction, 6> face_frictions(const FaceFrictionSpread& spread) {
  std::mt19937_64 random(spread.seed);
  const auto uniform = [&](double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  // Of a uniform distribution over twice the standard deviation to both sides, narrowed to have that deviation.
  const double most = spread.factor * std::sqrt(3);
  std::array<FaceFriction, 6> faces;
  for (FaceFriction& face : faces) {
    face = spread.mean;
    face.breakaway *= 1 + uniform(-most, most);
    face.kinetic *= 1 + uniform(-most, most);
    face.ripple_phase = uniform(0, 2 * std::numbers::pi);
    face.jam = uniform(0, spread.jam);
    face.jam_angle = uniform(0.2, kQuarter - 0.2);
  }
  return faces;
}

FaceDrive::Action FaceDrive::step(double angle, double speed, double h) {
  const double off = angle - kQuarter * std::round(angle / kQuarter);  // from the nearest seat
  if (std::abs(off) > kSeat) seated_ = false;
  if (std::abs(off) < kSeat && std::abs(speed) < kSeatingSpeed) seated_ = true;
  if (seated_) return {-off / std::max(kSettling, h), f_.breakaway, f_.breakaway, 0};
  if (std::abs(off) < kDetent)
    return {0, f_.detent_friction, f_.detent_friction,
            -f_.detent * std::sin(std::numbers::pi * off / kDetent)};

  double within = std::fmod(angle, kQuarter);
  if (within < 0) within += kQuarter;
  const double from_jam = std::abs(within - f_.jam_angle) / f_.jam_width;
  if (came_ != 0 && from_jam >= 1) {
    tightness_ *= 1 - f_.jam_loosening;
    came_ = 0;
  }
  if (came_ == 0 && from_jam < 1) came_ = within < f_.jam_angle ? 1 : -1;
  const double jam = came_ == 0 ? 0 : tightness_ * f_.jam * (1 - from_jam);
  const double friction =
      f_.kinetic * (1 + f_.ripple * std::sin(8 * angle + f_.ripple_phase)) + f_.viscous * std::abs(speed);
  return {0, friction + (came_ < 0 || f_.jam_direction < 0 ? 0 : jam),
          friction + (came_ > 0 || f_.jam_direction > 0 ? 0 : jam), 0};
}

}  // namespace mrroc::sim
