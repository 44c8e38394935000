#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "base/text_file.hpp"
#include "tasks/drawing/svg.hpp"
#include "tasks/guide/config.hpp"

namespace mrroc::guide {
namespace {

drawing::Stroke chosen(const drawing::Drawing& drawing, const std::string& file, int stroke) {
  const auto strokes = static_cast<int>(drawing.size());
  if (stroke == 0 && strokes > 1)
    throw FaultError(FaultCode::bad_usage,
                     fmt::format("{} has {} strokes, and a fixture is one curve", file, strokes),
                     fmt::format("choose one with --stroke 1..{}", strokes));
  if (stroke > strokes)
    throw FaultError(
        FaultCode::bad_usage, fmt::format("{} has no stroke {}", file, stroke),
        strokes > 1 ? fmt::format("choose one with --stroke 1..{}", strokes) : "leave out --stroke");
  const drawing::Stroke& points = drawing[static_cast<std::size_t>(std::max(stroke, 1) - 1)];
  if (points.size() < 2)
    throw FaultError(FaultCode::bad_drawing,
                     fmt::format("{}: the stroke is a single point, and a fixture is a curve", file),
                     "draw a line or a shape");
  return points;
}

}  // namespace

std::vector<std::string> fixture_settings(const std::string& fixture, std::optional<double> size,
                                          int stroke) {
  const bool file = fixture.ends_with(".svg");
  if (!file && (size || stroke > 0))
    throw FaultError(FaultCode::bad_usage, "--size and --stroke are for a fixture that an SVG file draws",
                     "give --fixture FILE.svg, or set task.length, task.width or task.radius");
  if (fixture.empty()) return {};
  if (!file) {
    if (std::error_code none; std::filesystem::is_directory(fixture, none))
      throw FaultError(FaultCode::bad_usage,
                       fmt::format("--fixture {}: this is a folder, and a fixture is a file", fixture),
                       "name an SVG file in it, or give line, plane or circle");
    if (fixture != "line" && fixture != "plane" && fixture != "circle")
      throw FaultError(FaultCode::bad_usage, fmt::format("--fixture {}: there is no such fixture", fixture),
                       "give line, plane, circle or a file whose name ends with .svg");
    return {"task.fixture=" + fixture};
  }
  try {
    const drawing::Stroke points =
        chosen(drawing::read_svg(fixture, size.value_or(drawing::kDefaultSize)), fixture, stroke);
    std::string numbers;
    for (const drawing::Point& p : points)
      numbers += fmt::format("{}{:.4f},{:.4f}", numbers.empty() ? "" : ",", p.x(), p.y());
    return {"task.fixture=curve", "task.curve=[" + numbers + "]"};
  } catch (const FileError& e) {
    throw FaultError(FaultCode::bad_drawing, e.wrong(), e.remedy());
  }
}

}  // namespace mrroc::guide
