// The drawing of a run: the built-in arrow, an SVG file, or a recording that was taught before.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "tasks/drawing/drawing.hpp"
#include "tasks/drawing/recording.hpp"

namespace mrroc {
class CommandLine;
}  // namespace mrroc

namespace mrroc::drawing {

/// The options --drawing, --size, --save and --load.
struct InputOptions {
  std::filesystem::path drawing;  ///< SVG; empty: the arrow
  std::optional<double> size;     ///< larger side [mm]; none: kDefaultSize
  std::filesystem::path save;     ///< where the recording goes
  std::filesystem::path load;     ///< recording to reproduce without a teach-in
};

/// The drawing of a run.
struct Input {
  Drawing drawing;               ///< what the hand leads along; with a recording: its taught ink
  std::optional<Taught> taught;  ///< the recording, when there is one
  std::string name;              ///< for the operator

  /// @return where the pens are to begin [mm]
  [[nodiscard]] Point start() const { return drawing.front().front(); }
  /// @return the recording and the ink that were taught; nothing: there is to be a teach-in
  [[nodiscard]] std::optional<Recording> recording() const;
  [[nodiscard]] std::optional<Ink> taught_ink() const;
  /// @return one line for the operator
  [[nodiscard]] std::string about() const;
};

/// Adds the options to a program's command line.
void add_input_options(CommandLine& line, InputOptions& options);

/// Reads what the options name.
/// @throws FileError, FaultError bad_usage
Input read_input(const InputOptions& options);

/// The drawing in a run folder, as ink.
inline constexpr const char* kInputFile = "input.csv";

/// Writes kInputFile, and the recording where there is one. @throws FaultError cannot_write
void write_input(const std::filesystem::path& folder, const Input& input);

/// @return options that read the recording of a run folder; where its pens began is in its configuration
[[nodiscard]] InputOptions input_of_run(const std::filesystem::path& folder);

/// @return the task's built-in configuration, tasks/drawing/drawing.toml
std::string_view default_config();

}  // namespace mrroc::drawing
