// What a run has found: the balls in both bases, the bases to each other, and the tools; and the figures by which it is
// judged.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "ecp/generators/weighing.hpp"
#include "mp/arm_trace.hpp"
#include "tasks/calibrate_cell/fit.hpp"
#include "tasks/calibrate_cell/probing.hpp"

namespace mrroc::calibrate_cell {

inline constexpr std::size_t kArms = 2;
/// Keys of the arms.
inline constexpr std::array<const char*, kArms> kKeys{"arm1", "arm2"};

/// Where the bases stand in the world.
using Bases = std::array<Pose, kArms>;

/// @return the touches in a table, in order, from the rows of `measure`
[[nodiscard]] std::vector<Touch> touches_of(const mp::ArmTrace& trace, const ProbePlan& plan);
/// @return the tool that was weighed; without weight when it was not
[[nodiscard]] ecp::ForceTool tool_of(const mp::ArmTrace& trace);

/// What the touches say.
struct Calibration {
  std::array<std::vector<BallFit>, kArms> balls;  ///< in the bases of the arms
  PoseFit T_12;  ///< base of arm2 in that of arm1, and how well the balls agree
};
/// @param traces  of both arms
/// @return nothing: balls were not touched, or leave a direction open
[[nodiscard]] std::optional<Calibration> calibration_of(const std::vector<mp::ArmTrace>& traces,
                                                        const std::array<ProbePlan, kArms>& plans);

/// @return distances of the touches from the spheres of their balls, and of the balls of one arm from those of the other,
///         per number that is too many, rms [m]: what is left of them with errors of the arms' geometry, and noise
[[nodiscard]] double misfit(const Calibration& found);

/// @return base of the second arm in that of the first one
[[nodiscard]] inline Pose relation(const Bases& bases) { return bases[0].inverse() * bases[1]; }

/// @param T_12  base of arm2 in that of arm1 as it was found; none: it was not
/// @param believed,real  bases before the run, and as they are in the simulator; none: nobody knows
/// @return base_err_mm, base_err_deg and what was before, tool_weight_N; NaN where nothing was found
[[nodiscard]] mp::TaskFigures figures(const std::vector<mp::ArmTrace>& traces,
                                      const std::optional<Pose>& T_12, const Bases& believed,
                                      const std::optional<Bases>& real);
/// @return touch_rms_mm, balls_rms_mm; NaN where nothing was found
[[nodiscard]] mp::TaskFigures touch_figures(const std::optional<Calibration>& found);

}  // namespace mrroc::calibrate_cell
