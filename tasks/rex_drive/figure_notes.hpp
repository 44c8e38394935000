// What a run's figures cannot tell, and what is therefore not wanted of them.
#pragma once
#include <string>
#include <vector>

#include "mp/figure_table.hpp"
#include "tasks/rex_drive/drive_case.hpp"

namespace mrroc::rex_drive {

/// What the figures of a run depend on beside its drive.
struct FigureContext {
  bool smooth{};                    ///< the ground has the law of friction that the estimator believes in
  std::vector<std::string> eyes{};  ///< keys of cameras and odometry that are not as they are built in
};

/// @param drive  of the run
/// @return figures_of_case() without what this run cannot show: friction that was not measured, and the odometry of eyes that
///         were told to see worse, or otherwise, than the built-in ones
[[nodiscard]] std::vector<mp::FigureInfo> figures_of_run(DriveCase drive, const mp::Figures& figures,
                                                         const FigureContext& context);

/// @return lines below the table of figures: why one was not measured, is not what it seems, or is not judged; each ends with
///         a line feed
[[nodiscard]] std::string figure_notes(const mp::Figures& figures, const FigureContext& context);

}  // namespace mrroc::rex_drive
