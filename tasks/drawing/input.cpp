#include "tasks/drawing/input.hpp"

#include <fmt/core.h>

#include <system_error>

#include "base/command_line.hpp"
#include "base/counted.hpp"
#include "base/fault.hpp"
#include "tasks/drawing/strokes.hpp"
#include "tasks/drawing/svg.hpp"

namespace mrroc::drawing {
namespace {

constexpr const char* kLoaded = "loaded.recording";  // in a run folder

}  // namespace

void add_input_options(CommandLine& line, InputOptions& o) {
  const Option drawing =
      line.option("--drawing", o.drawing, "what is taught: an SVG file (default: an arrow with six feathers)")
          .type_name("FILE.svg");
  const Option size = line.option("--size", o.size,
                                  fmt::format("larger side of the drawing (default {:g}, at most {:g})",
                                              kDefaultSize, kSheetSize))
                          .type_name("MM");
  const Option save = line.option("--save", o.save, "keeps the taught recording").type_name("FILE");
  line.option("--load", o.load, "reproduces a recording without a new teach-in")
      .type_name("FILE")
      .excludes(drawing)
      .excludes(size)
      .excludes(save);
}

Input read_input(const InputOptions& o) {
  Input input;
  std::error_code error;
  const auto status = std::filesystem::status(o.save, error);
  if (error && error != std::errc::no_such_file_or_directory)
    throw FaultError(FaultCode::bad_usage, fmt::format("--save cannot be this file: {}", error.message()),
                     "choose another");
  if (!o.save.empty() && o.save.has_parent_path() && !std::filesystem::is_directory(o.save.parent_path()))
    throw FaultError(FaultCode::bad_usage, fmt::format("--save {}: there is no such folder", o.save.string()),
                     "make it, or choose another");
  if (std::filesystem::is_directory(status))
    throw FaultError(FaultCode::bad_usage, fmt::format("--save {}: this is a folder", o.save.string()),
                     "give the name of a file");
  if (!o.load.empty()) {
    input.taught = load(o.load);
    input.drawing = strokes_of(input.taught->ink);
    input.name = fmt::format("recording {}", o.load.string());
    check(input.drawing, o.load.string(), input.taught->ink.size());
    return input;
  }
  std::string name = o.drawing.empty() ? "arrow (built in)" : o.drawing.string();
  const double size = o.size.value_or(kDefaultSize);
  check_size(size, name);
  std::string ignored;
  input.drawing = o.drawing.empty() ? fitted(arrow(), size) : read_svg(o.drawing, size, &ignored);
  check(input.drawing, name);
  input.name = ignored.empty() ? name : fmt::format("{} (left out: {})", name, ignored);
  return input;
}

void write_input(const std::filesystem::path& folder, const Input& input) {
  write_ink(folder / kInputFile, ink_of(input.drawing));
  if (input.taught) save(folder / kLoaded, *input.taught);
}

InputOptions input_of_run(const std::filesystem::path& folder) {
  InputOptions o;
  if (std::filesystem::exists(folder / kLoaded)) o.load = folder / kLoaded;
  return o;
}

std::optional<Recording> Input::recording() const {
  return taught ? std::optional(taught->recording) : std::nullopt;
}

std::optional<Ink> Input::taught_ink() const { return taught ? std::optional(taught->ink) : std::nullopt; }

std::string Input::about() const {
  double sum = 0;
  std::size_t points = 0;
  for (const Stroke& s : drawing) {
    sum += length(s);
    points += s.size();
  }
  return fmt::format("{}: {}, {}, {:.0f} mm", name, counted(drawing.size(), "stroke"),
                     counted(points, "point"), sum);
}

}  // namespace mrroc::drawing
