// Reads by how much the plant is otherwise than it is believed: places, turns and masses. Without such keys nothing is.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/config.hpp"
#include "base/pose.hpp"
#include "sim/link_error.hpp"

namespace mrroc::sim {

/// Largest legal errors.
struct ErrorBounds {
  double shift{0.1};  ///< along each axis [m]
  double turn{0.2};   ///< about each axis [rad]
};

/// @param about, believed  as Meaning has them
/// @return TABLE.x, .y, .z [m]
/// @throws ConfigError
[[nodiscard]] Vector3 read_shift(const Config& table, const std::string& about, std::string_view believed,
                                 const ErrorBounds& bounds = {});

/// The same of TABLE.ax, .ay, .az, an angle times its axis [rad].
[[nodiscard]] Vector3 read_turn(const Config& table, const std::string& about, std::string_view believed,
                                const ErrorBounds& bounds = {});

/// Both of them, as a displacement: the true pose is the believed one times this, unless who reads it says otherwise.
[[nodiscard]] Pose read_displacement(const Config& table, const std::string& about, std::string_view believed,
                                     const ErrorBounds& bounds = {});

/// @return whether there is none
[[nodiscard]] bool is_none(const Pose& displacement);

/// @return T * displacement; without one T with its bits as they are
[[nodiscard]] Pose displaced(const Pose& T, const Pose& displacement);

/// Reads mass_scale and mass_centre_error of all links of an arm, of links.NAME, and of its tool; zero_error of links.NAME,
/// and tip_error of the tool, which is along and about the axes of W.
/// @param arm    its table
/// @param links  as link_names() gives them
/// @return one per link that is otherwise
/// @throws ConfigError
[[nodiscard]] std::vector<LinkError> read_link_errors(const Config& arm,
                                                      const std::vector<std::string>& links);

}  // namespace mrroc::sim
