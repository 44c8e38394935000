// Cases of the platform's task that are driven without eyes and with them.
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/rex_drives.hpp"

namespace mrroc::bench {

/// @return the figure eight at 1.3 m/s where curves allow it
[[nodiscard]] Arguments fast_eight();
/// @return the corner at 0.8 m/s
[[nodiscard]] Arguments fast_corner();
/// @return grounds of the estimator's own structure: whole, with half the friction, and with half of it on the right
[[nodiscard]] std::vector<Arguments> smooth_grounds();
/// @return such a ground whose friction halves everywhere while the platform is in a curve
[[nodiscard]] Arguments halving_ground();
/// @return a plant that the driver does not know
[[nodiscard]] Arguments random_plant(std::uint32_t seed);

/// @return a drive with eyes in which everything is drawn that the driver does not know: plant, plan, room, and when the map is
///         lost for 8 s
[[nodiscard]] RexDrive random_drive(std::uint32_t seed);

/// @return `track_rms_mm` of a plant; one that does not end well is worse than any: infinite
[[nodiscard]] double track_rms(const nlohmann::json& summary);

}  // namespace mrroc::bench
