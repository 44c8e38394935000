// From what a run has left to its files and figures.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mp/run_folder.hpp"
#include "tasks/drawing/drawing_run.hpp"
#include "tasks/drawing/ink.hpp"

namespace mrroc::drawing {

/// Ink of a run.
struct RunInk {
  std::optional<Ink> taught;                    ///< of the taught pen, or as loaded
  std::array<std::optional<Ink>, kArms> drawn;  ///< of each arm while reproducing
};

/// Takes the inked sheets that the world left (ARM-sheet-K.csv) out of the run folder.
/// @param loaded  the taught ink when there was no teach-in
RunInk collect_ink(const std::filesystem::path& folder, const std::vector<std::string>& arms,
                   std::optional<Ink> loaded);

/// Writes arm1.csv, arm2.csv, taught.csv, ink1.csv and ink2.csv, as far as they exist.
void write_tables(const std::filesystem::path& folder, const RunRecord& record, const RunInk& ink);

/// @param finished  whether the drawing came to its end; if not, errors of ink that lacks strokes are left out
/// @return the figures of the task as far as they can be told: see docs/interfaces.md
std::map<std::string, mp::Figure> figures_of(const Drawing& input, bool taught_here, const RunRecord& record,
                                             const RunInk& ink, const Parameters& k, bool finished);

}  // namespace mrroc::drawing
