// The force/torque sensors that an arm may have in its wrist: calibrations of one transducer, an ATI Gamma.
#pragma once
#include <string>

#include "base/config.hpp"
#include "base/spatial.hpp"

namespace mrroc::robots {

/// What a calibration measures, and how finely. Source: ATI's figures of SI-65-5 and SI-130-10.
struct ForceSensorType {
  /// |reading| along and about the axes of the sensor at which it saturates [N, N m].
  Wrench range{{65, 65, 200, 5, 5, 5}};
  double coarseness{1};  ///< noise and increments over those of SI-65-5
};

/// @param arm  of the configuration, e.g. "arm1" @return `robots.ARM.sensor`: SI-65-5 unless it says otherwise
/// @throws ConfigError
[[nodiscard]] ForceSensorType read_force_sensor_type(const Config& config, const std::string& arm);

}  // namespace mrroc::robots
