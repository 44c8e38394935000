// Makes the files and figures of a run.
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

/// Takes the inked sheets that the simulator left (ARM-sheet-K.csv) out of the run folder.
/// Hops of the hand that taught are joined (without_hops); the arms' ink stays as it is, so that an arm that hops is
/// seen to leave strokes_extra.
/// @param loaded  the taught ink when there was no teach-in
RunInk collect_ink(const std::filesystem::path& folder, const std::vector<std::string>& arms,
                   std::optional<Ink> loaded);

/// Writes taught.csv, ink1.csv and ink2.csv, as far as they exist.
void write_tables(const std::filesystem::path& folder, const RunInk& ink);

/// Writes what was taught, for another run; says so when the teach-in has not come to its end.
/// @throws FaultError cannot_write
void save_taught(const std::filesystem::path& file, const RunRecord& record, const RunInk& ink);

/// @param finished  whether the drawing came to its end; if not, errors of ink that lacks strokes are left out
/// @return the figures of the task as far as they can be told: see docs/interfaces.md. What does not apply to a
/// finished drawing, such as travel_z_mm to one without a travel, is not among them; what should have been
/// measured and was not is nan
std::map<std::string, mp::Figure> figures_of(const Drawing& input, bool taught_here, const RunRecord& record,
                                             const RunInk& ink, const Parameters& k, bool finished);

/// @return lines on what a person should look at: a pen that did not leave as many strokes as it was to draw, which
///         usually are too close to one another, and of a run that came to its end what copy_warning() says
std::string warnings(const mp::Summary& summary);

/// @return a line when a figure says that the copies differ from what was taught, and one when the memory is doubtful
std::string copy_warning(const std::map<std::string, mp::Figure>& figures);

}  // namespace mrroc::drawing
