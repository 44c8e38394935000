#include "tasks/haptic/passivity.hpp"

#include <algorithm>

namespace mrroc::haptic {
namespace {

/// What may come out [J].
double allowed(const PortEnergy& port, const PassivityLaw& law) {
  return port.observed() - port.given_up + law.start;
}

}  // namespace

PortEnergy hear(PortEnergy port, const PassivityLaw& law, double heard) {
  port.heard = std::max(port.heard, heard);
  port.given_up += std::max(0.0, allowed(port, law) - law.start - law.surplus);
  return port;
}

Passed pass(PortEnergy port, const PassivityLaw& law, const Vector3& output, const Vector3& input, double dt,
            double damped) {
  port.store = std::max(port.store, std::min(law.store, port.store + law.share * damped));
  Passed passed{port, output};
  PortEnergy& p = passed.port;
  const double work = dt * output.dot(input);
  if (work <= 0) {
    const double kept =
        std::clamp(law.start - p.store, 0.0, -work);  // noise goes to and fro: it is not sent on
    p.store += kept;
    p.in += -work - kept;
    return passed;
  }
  const double may = p.store + std::max(0.0, allowed(p, law));
  const double too_much = law.control ? std::clamp(work - may, 0.0, work) : 0;
  // dt output . input falls by too_much: this is the damping, or compliance, too_much / (dt input^2) of the controller.
  passed.output -= too_much / (dt * input.squaredNorm()) * input;
  const double stored = std::min(p.store, work - too_much);
  p.store -= stored;
  p.out += work - too_much - stored;
  p.kept_back += too_much;
  return passed;
}

}  // namespace mrroc::haptic
