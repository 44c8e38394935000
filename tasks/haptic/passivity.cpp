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

Passed pass(PortEnergy port, const PassivityLaw& law, const Vector3& output, const Vector3& input,
            double dt) {
  Passed passed{port, output};
  const double work = dt * output.dot(input);
  if (work <= 0) {
    passed.port.in -= work;
    return passed;
  }
  const double too_much = law.control ? std::clamp(work - std::max(0.0, allowed(port, law)), 0.0, work) : 0;
  // dt output . input falls by too_much: this is the damping, or compliance, too_much / (dt input^2) of the controller.
  passed.output -= too_much / (dt * input.squaredNorm()) * input;
  passed.port.out += work - too_much;
  passed.port.kept_back += too_much;
  return passed;
}

}  // namespace mrroc::haptic
