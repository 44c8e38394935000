// SVG: what is read can be drawn, and written as polylines reads as the same drawing.
#include <fmt/core.h>

#include <vector>

#include "tasks/drawing/svg.hpp"
#include "test/fuzz/fuzz.hpp"

using namespace mrroc;

namespace {

std::string polylines(const drawing::Drawing& drawing) {
  std::string text = "<svg>";
  for (const drawing::Stroke& stroke : drawing) {
    text += "<polyline points='";
    for (const drawing::Point& p : stroke) text += fmt::format("{} {} ", p.x(), -p.y());
    text += "'/>";
  }
  return text + "</svg>";
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr double kSame = 1e-5;  // [mm] repeated points are dropped within a tenth of it
  drawing::Drawing drawing;
  std::string ignored;
  try {
    drawing = drawing::parse_svg(fuzz::text_of(data, size), "f.svg", drawing::kDefaultSize, &ignored);
  } catch (const FileError& e) {
    fuzz::require_readable(e.what());
    return 0;
  }
  if (!ignored.empty()) fuzz::require_readable(ignored);
  drawing::check(drawing, "f.svg");  // throws nothing
  const drawing::Drawing again = drawing::parse_svg(polylines(drawing), "again.svg");
  fuzz::require(again.size() == drawing.size(), "a drawing keeps its strokes");
  for (std::size_t k = 0; k < drawing.size(); ++k) {
    fuzz::require((again[k].front() - drawing[k].front()).norm() < kSame &&
                      (again[k].back() - drawing[k].back()).norm() < kSame,
                  "a stroke keeps its ends");
  }
  return 0;
}
