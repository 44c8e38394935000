#include "tasks/rubik/turn/order.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::rubik {
namespace {

// Beyond all that is meant; what a driver executes is checked there.
constexpr double kMostTorque = 100;     // [N m]
constexpr double kMostMobility = 100;   // [s/(kg m^2)]
constexpr double kMostAngle = 100;      // [rad]
constexpr double kMostMotor = 1e5;      // [rad]
constexpr double kWidestJaws = 1;       // [m]
constexpr double kMostWeight = 1000;    // [N]
constexpr double kFarthestCentre = 10;  // [m]

}  // namespace

cube_order_t to_message(const CubeOrder& o) {
  cube_order_t m{};
  m.torque = o.turn.torque;
  m.mobility = o.turn.mobility;
  m.angle = o.turn.angle;
  m.jaw_step = o.jaw_step;
  std::ranges::copy(o.point.motors, m.motors);
  m.speed = o.point.speed;
  m.jaws = o.jaws;
  m.weight = o.weight;
  std::ranges::copy(o.mass_centre, m.mass_centre);
  return m;
}

cube_report_t to_message(const CubeReport& r) {
  cube_report_t m{};
  m.points = r.points;
  return m;
}

}  // namespace mrroc::rubik

namespace mrroc {

rubik::CubeOrder from_message(const cube_order_t& m) {
  rubik::CubeOrder o;
  o.turn = {.torque = m.torque, .mobility = m.mobility, .angle = m.angle};
  o.jaw_step = m.jaw_step;
  std::ranges::copy(m.motors, o.point.motors.begin());
  o.point.speed = m.speed;
  o.jaws = m.jaws;
  o.weight = m.weight;
  std::ranges::copy(m.mass_centre, o.mass_centre.begin());
  return o;
}

rubik::CubeReport from_message(const cube_report_t& m) { return {.points = m.points}; }

bool is_proper(const cube_order_t& m) noexcept {
  // Comparisons with a NaN are false.
  const auto within = [](double x, double least, double most) { return x >= least && x <= most; };
  const auto all = [&](const auto& numbers, double most) {
    return std::ranges::all_of(numbers, [&](double x) { return within(x, -most, most); });
  };
  return within(m.torque, -rubik::kMostTorque, rubik::kMostTorque) &&
         within(m.mobility, 0, rubik::kMostMobility) &&
         within(m.angle, -rubik::kMostAngle, rubik::kMostAngle) &&
         within(m.jaw_step, 0, rubik::kWidestJaws) && all(m.motors, rubik::kMostMotor) &&
         within(m.speed, 0, 1) && within(m.jaws, 0, rubik::kWidestJaws) &&
         within(m.weight, 0, rubik::kMostWeight) && all(m.mass_centre, rubik::kFarthestCentre);
}

bool is_proper(const cube_report_t& m) noexcept { return m.points >= 0 && m.points <= rubik::kMostPoints; }

}  // namespace mrroc
