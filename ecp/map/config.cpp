#include "ecp/map/config.hpp"

#include <fmt/core.h>

#include <cmath>

namespace mrroc::ecp {
namespace {

std::int64_t macrosteps(double seconds) { return std::llround(seconds / kPlatformPeriod); }

}  // namespace

MapParameters read_map(const Config& config) {
  const Config m = config.section("map");
  MapParameters k;
  k.capture = read_motion_capture(config);
  const auto noise = m.numbers<2>("noise", {{k.position_sd, k.heading_sd}}, {1e-4, 1}, "m, rad");
  k.position_sd = noise[0];
  k.heading_sd = noise[1];
  k.rejections = m.integer("rejections", k.rejections, {1, 1000},
                           "in a row that agree with each other, which open the gate again");
  k.timeout = macrosteps(m.number("timeout", 0.5, {0.1, 60}, "s"));
  if (k.timeout * k.n_s < k.capture.period)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format("map.timeout: motion capture measures every {} steps, which is longer", k.capture.period),
        "make map.timeout longer, or motion_capture.period shorter");
  return k;
}

}  // namespace mrroc::ecp
