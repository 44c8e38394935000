// The table of all regulators of one motor, and the choice among them.
#pragma once
#include <array>

#include "edp/compensating_regulator.hpp"
#include "edp/regulator.hpp"

namespace mrroc::edp {

/// Algorithms of the servo: 0 IncrementalRegulator, 1 CompensatingRegulator.
inline constexpr int kServoAlgorithms = 2;
/// Parameter sets of each algorithm.
inline constexpr int kServoSets = 2;

/// A regulator of one motor.
struct ServoChoice {
  int algorithm_no{};      ///< 0..kServoAlgorithms - 1
  int parameter_set_no{};  ///< 0..kServoSets - 1
  constexpr bool operator==(const ServoChoice&) const = default;
};

/// Everything that the regulators of one motor need to know.
struct ServoCoefficients {
  ServoChoice standard;                                           ///< chosen when the driver starts
  std::array<RegulatorCoefficients, kServoSets> incremental;      ///< algorithm 0
  std::array<CompensationCoefficients, kServoSets> compensating;  ///< algorithm 1
  DriveModel drive;                                               ///< known to algorithm 1
};

}  // namespace mrroc::edp
