#include "robots/rex/platform_type.hpp"

#include "robots/rex/parameters.hpp"
#include "robots/rex/rex.hpp"

namespace mrroc::rex {
namespace {

robots::PlatformType make_type() {
  robots::PlatformType t;
  t.name = "rex";
  t.platform = platform;
  t.plant = {.mass = kMass,
             .inertia = kInertia,
             .wheel_radius = kWheelRadius,
             .half_wheelbase = kHalfBase,
             .half_track = kHalfTrack,
             .wheel_inertia = kWheelInertia,
             .bearing_friction = kBearingFriction,
             .slip_speed = kSlipSpeed,
             .max_torque = kMaxTorque,
             .full_torque_speed = kFullTorqueSpeed,
             .no_torque_speed = kMaxWheelSpeed,
             .brake = kBrake,
             .quick_stop = kBrakingTorque,
             .increments_per_turn = kIncrementsPerTurn,
             .torque_constant = kTorqueConstant,
             .length = kLength,
             .width = kWidth};
  t.urdf = urdf();
  return t;
}

}  // namespace

const robots::PlatformType& type() {
  static const robots::PlatformType made = make_type();
  return made;
}

}  // namespace mrroc::rex
