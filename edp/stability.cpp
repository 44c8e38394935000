#include "edp/stability.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "base/fault.hpp"
#include "edp/contact_map.hpp"

namespace mrroc::edp {
namespace {

using std::numbers::pi;

constexpr double kStiffest = 1e9;  // [N/m]

void check(const CompensatedDrive& drive) {
  const bool good = drive.regulator.bandwidth > 0 && drive.regulator.observer > 0 &&
                    drive.model.resistance > 0 && drive.model.inertia > 0 && drive.increments_per_rad > 0 &&
                    drive.inertia > 0 && drive.lever != 0;
  if (!good)
    throw FaultError(FaultCode::out_of_limits,
                     "stability: a drive needs its regulator, model, increments, inertia and lever");
}

void check(const WholeArm& arm) {
  const auto n = static_cast<Eigen::Index>(arm.drives.size());
  const auto square = [n](const AxisMatrix& m) { return m.rows() == n && m.cols() == n; };
  const bool fits = n > 0 && square(arm.motors_per_joints) && square(arm.mass) && arm.tip.size() == n &&
                    arm.set.size() == n && arm.tool_centre.size() == n;
  const auto whole = [](const ArmDrive& d) {
    return d.regulator.bandwidth > 0 && d.regulator.observer > 0 && d.model.resistance > 0 &&
           d.model.inertia > 0 && d.increments_per_rad > 0 && d.rotor > 0;
  };
  if (!fits || !std::ranges::all_of(arm.drives, whole) || arm.tool < 0 || arm.wheels < 0 || arm.wheels >= 1)
    throw FaultError(
        FaultCode::out_of_limits,
        "stability: an arm needs a drive a joint, each with its regulator, model, increments and "
        "rotor, and matrices and ways of as many joints");
}

bool sensible(const GearMode& gears, const ServoModel& servo) {
  if (gears.frequency == 0) return true;
  const auto has_rotor = [&](const auto& of) {
    if constexpr (requires { of.lever; }) return gears.mass * of.lever * of.lever < of.inertia;
    return true;
  };
  return gears.frequency >= 1 && gears.frequency <= 100 && gears.damping >= 0 && gears.damping <= 1 &&
         gears.mass > 0 && gears.tool >= 0 && gears.tool <= gears.mass && std::visit(has_rotor, servo);
}

ContactMode mode_of(const ContactLoop& loop, double K) {
  ContactMode worst{.damping = 1};
  for (const std::complex<double>& z : ContactMap(loop, K).matrix().eigenvalues()) {
    worst.radius = std::max(worst.radius, std::abs(z));
    if (std::abs(z) < 1e-4) continue;  // gone within a step
    const std::complex<double> s = std::log(z) / loop.dt;
    if (std::abs(s) < 1e-9 || -s.real() / std::abs(s) >= worst.damping) continue;
    worst.damping = -s.real() / std::abs(s);
    worst.frequency = std::abs(s.imag()) / (2 * pi);
  }
  return worst;
}

bool stable(const ContactLoop& loop, double K) { return mode_of(loop, K).radius < 1; }

}  // namespace

void check_loop(const ContactLoop& loop) {
  const auto demand = [](bool good, const char* what) {
    if (!good) throw FaultError(FaultCode::out_of_limits, std::string("stability: ") + what);
  };
  demand(loop.inertia >= 0 && loop.inertia <= 1e6, "I must lie between 0 and 1e6");
  demand(loop.mobility > 0 && loop.mobility <= 1e3, "B must be above 0, and at most 1000");
  demand(loop.dt > 0 && loop.dt <= 0.1, "dt must be above 0, and at most 0.1 s");
  demand(loop.delay >= 0 && loop.delay <= 20, "the delay must lie between 0 and 20 steps");
  demand(loop.average >= 1 && loop.average <= 20, "the average must lie between 1 and 20 readings");
  demand(loop.low_pass >= 0, "the corner of the low pass must not be negative");
  demand(loop.contact_damping >= 0 && loop.contact_damping <= 1,
         "contact damping must lie between 0 and 1 s");
  demand(sensible(loop.gears, loop.servo),
         "gears need 1 to 100 Hz, or 0, a damping ratio of 0 to 1, and a mass that leaves the rotor some "
         "inertia, and a tool that is a part of it");
  if (const auto* lag = std::get_if<LagServo>(&loop.servo)) {
    demand(lag->bandwidth > 0 && lag->bandwidth <= 1e4, "the bandwidth must be above 0, at most 1e4 Hz");
    demand(lag->order == 1 || lag->order == 2, "the order of the servo must be 1 or 2");
    demand(lag->damping > 0 && lag->damping <= 10, "the servo's damping must be above 0, at most 10");
    demand(lag->feed_forward >= 0 && lag->feed_forward <= 1, "feed-forward must lie between 0 and 1");
  }
  if (const auto* drive = std::get_if<RegulatedDrive>(&loop.servo))
    demand(drive->increments_per_rad > 0 && drive->speed_gain > 0 && drive->time_constant > 0 &&
               drive->inertia > 0 && drive->lever != 0,
           "a drive needs increments, gain, time constant, inertia and lever");
  if (const auto* drive = std::get_if<CompensatedDrive>(&loop.servo)) check(*drive);
  if (const auto* arm = std::get_if<WholeArm>(&loop.servo)) check(*arm);
}

ContactMode contact_mode(const ContactLoop& loop, double stiffness) {
  check_loop(loop);
  if (!(stiffness >= 0 && stiffness <= kStiffest))
    throw FaultError(FaultCode::out_of_limits, "stability: the stiffness must lie between 0 and 1e9");
  return mode_of(loop, stiffness);
}

double stiffness_limit(const ContactLoop& loop) {
  check_loop(loop);
  constexpr double kStride = 1.2;
  // Softer contact is slower than rounding can tell from standing still.
  double good = 1e-6 / (loop.mobility * loop.dt);
  if (!stable(loop, good)) return 0;
  double bad = good * kStride;
  while (stable(loop, bad)) {
    good = bad;
    bad *= kStride;
    if (bad > kStiffest) return std::numeric_limits<double>::infinity();
  }
  while (bad / good > 1 + 1e-6) {
    const double middle = std::sqrt(good * bad);
    (stable(loop, middle) ? good : bad) = middle;
  }
  return bad;
}

double mobility_for(ContactLoop loop, double stiffness, double damping) {
  const auto enough = [&](double B) {
    loop.mobility = B;
    return contact_mode(loop, stiffness).damping >= damping;
  };
  constexpr double kLeast = 1e-7, kMost = 10, kStride = 1.1;
  double bad = kMost;
  while (bad > kLeast && !enough(bad / kStride)) bad /= kStride;
  if (bad <= kLeast) return 0;
  double good = bad / kStride;
  while (bad / good > 1 + 1e-4) {
    const double middle = std::sqrt(good * bad);
    (enough(middle) ? good : bad) = middle;
  }
  return good;
}

}  // namespace mrroc::edp
