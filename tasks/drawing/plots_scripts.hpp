// gnuplot scripts of the pictures. Internal to the plots.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "tasks/drawing/plots.hpp"

namespace mrroc::drawing {

/// The tables of a run folder that there are.
struct RunTables {
  std::array<std::optional<mp::ArmTrace>, 2> arms;  ///< arm1.csv, arm2.csv
  std::optional<Ink> input, taught;                 ///< drawing that was asked for, ink of the teach-in
  std::array<std::optional<Ink>, 2> ink;            ///< of the two copies
};

/// Scripts run in the run folder and read arm1.csv and arm2.csv themselves. A script is empty when there is
/// nothing for it to draw.
/// @return MS fig. 8: the pen's path in space, a panel for teach-in and one for reproduction
[[nodiscard]] std::string trajectory_script(const RunTables& run, const PlotSetup& setup);
/// @return MS fig. 9: the pen's height above the paper over time
[[nodiscard]] std::string height_script(const RunTables& run, const PlotSetup& setup);
/// @return MS fig. 10: the vertical force over time
[[nodiscard]] std::string force_script(const RunTables& run);
/// @return the input drawing, the taught ink and both copies, in panels of one scale
[[nodiscard]] std::string drawing_script(const RunTables& run);

}  // namespace mrroc::drawing
