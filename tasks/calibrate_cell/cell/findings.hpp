// All that a run has found, in both ways, compared with each other and with the truth.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/fault.hpp"
#include "mp/arm_trace.hpp"
#include "tasks/calibrate_cell/cell/by_board.hpp"
#include "tasks/calibrate_cell/cell/kinematic_sets.hpp"
#include "tasks/calibrate_cell/result.hpp"

namespace mrroc::calibrate_cell {

/// Largest difference between both ways that their own errors explain.
inline constexpr PoseDistance kWaysAgree{.mm = 1, .deg = 0.1};

/// All that a run has found.
struct Findings {
  std::optional<SetsVerdict> touched;  ///< none: the balls were left out
  std::optional<ByBoard> pictured;     ///< none: pictures were left out, or do not tell
  std::optional<FaultError> unseen;    ///< why pictures do not tell

  /// @return base of arm2 in that of arm1 by touching; none: not found
  [[nodiscard]] std::optional<Pose> by_touch() const;
  /// @return the same by pictures
  [[nodiscard]] std::optional<Pose> by_pictures() const;
  /// @return the one that is believed from now on: by touching, where both are there
  [[nodiscard]] std::optional<Pose> T_12() const { return by_touch() ? by_touch() : by_pictures(); }
  /// @return between both ways; none: one of them is missing
  [[nodiscard]] std::optional<PoseDistance> difference() const;
};

/// @param traces  of both arms @param records  of the cameras @throws ConfigError
[[nodiscard]] Findings find_all(const std::vector<mp::ArmTrace>& traces,
                                const std::vector<CameraRecord>& records, const Config& config);

/// @return figures of all of it against the simulator's truth; NaN where nothing was found
[[nodiscard]] mp::TaskFigures figures_of(const Findings& findings, const std::vector<mp::ArmTrace>& traces,
                                         const Config& config);

/// @return for people how the bases were found, and whether both ways agree; lines, each ended by a line feed
[[nodiscard]] std::string describe_ways(const Findings& findings);

/// @throws FaultError kTouchesDoNotFit, kBoardNotSeen, bad_calibration: something was not found
[[nodiscard]] CellResult result_of(const Findings& findings, const std::vector<mp::ArmTrace>& traces,
                                   const Config& config);

}  // namespace mrroc::calibrate_cell
