// The tables in front of arms, as everybody is told of them. Their truth is the simulator's.
#pragma once
#include "base/config.hpp"

namespace mrroc {

/// What is told of the table in front of an arm, the same for all arms, and of what lies on it.
struct TableDescription {
  double distance{0.90};        ///< of the middle of the sheet from the arm's base, along x of the base [m]
  double height{0.92};          ///< of the sheet above the origin of the base [m]
  double stiffness{1e4};        ///< of paper and plates with the tool that touches them, in series [N/m]
  double damping_ratio{0.002};  ///< of the same, damping per stiffness [s]
  double friction{0.2};         ///< of the tool on them
};

/// Reads [table].
/// @throws ConfigError
[[nodiscard]] TableDescription read_table(const Config& config);

/// Legal values of what is told, and of what is true.
struct TableBounds {
  static constexpr Bounds kDistance{0.7, 1.1};    ///< [m]
  static constexpr Bounds kHeight{0.7, 1.2};      ///< [m]
  static constexpr Bounds kStiffness{100, 1e6};   ///< [N/m]
  static constexpr Bounds kDampingRatio{0, 0.1};  ///< [s]
  static constexpr Bounds kFriction{0, 2};
};

}  // namespace mrroc
