#include "tasks/drawing/svg.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/text_file.hpp"
#include "tasks/drawing/strokes.hpp"
#include "tasks/drawing/svg_document.hpp"

namespace mrroc::drawing {
namespace {

constexpr int kSamples = 32;  // per curve, to measure a drawing before its scale is known

// Fitting the polyline instead of its curve makes the scale a little larger; this much smaller a tolerance
// makes up for it.
double flattening_tolerance(double size_mm) { return std::min(0.9 * kFlatness, size_mm / 50); }

double extent(const std::vector<svg::SubPath>& paths) {
  Drawing sampled;
  for (const svg::SubPath& path : paths) {
    Stroke& stroke = sampled.emplace_back(Stroke{path.start});
    for (const svg::Segment& segment : path.segments) svg::append(stroke, segment, kSamples);
  }
  return bounds(sampled).sizes().maxCoeff();
}

Drawing flattened(const std::vector<svg::SubPath>& paths, double tolerance, const std::string& name) {
  constexpr double kAbsurd = 100 * static_cast<double>(kMaxPoints);  // repeated points are dropped only later
  Drawing drawing;
  double total = 0;
  for (const svg::SubPath& path : paths) {
    Stroke& stroke = drawing.emplace_back(Stroke{path.start});
    for (const svg::Segment& segment : path.segments) {
      const double count = svg::pieces(segment, tolerance);
      total += count;
      if (!(total < kAbsurd))
        throw FileError(name, 0, fmt::format("over {} points after flattening", kMaxPoints),
                        "simplify the drawing or draw it smaller");
      svg::append(stroke, segment, static_cast<int>(count));
    }
  }
  return drawing;
}

Drawing turned_up(Drawing drawing) {
  for (Stroke& stroke : drawing)
    for (Point& p : stroke) p.y() = -p.y();
  return drawing;
}

}  // namespace

Drawing parse_svg(std::string_view text, const std::string& name, double size_mm, std::string* ignored) {
  check_size(size_mm, name);
  const svg::Document document = svg::read_document(text, name);
  if (ignored) *ignored = document.ignored;
  if (document.paths.empty())
    throw FileError(
        name, 0,
        document.ignored.empty() ? "there is nothing to draw in it"
                                 : fmt::format("there is nothing to draw in it but {}", document.ignored),
        document.ignored.empty() ? "add paths, lines or shapes" : "convert text to paths and trace images");
  const double size = extent(document.paths);
  if (!std::isfinite(size)) throw FileError(name, 0, "its numbers are too large", "draw it smaller");
  const double units_per_mm = size > 0 ? size / size_mm : 1;
  const Drawing polylines = flattened(document.paths, flattening_tolerance(size_mm) * units_per_mm, name);
  Drawing drawing = without_repeats(fitted(turned_up(polylines), size_mm));
  check(drawing, name);
  return drawing;
}

Drawing read_svg(const std::filesystem::path& file, double size_mm, std::string* ignored) {
  return parse_svg(read_text_file(file, kMaxSvgBytes), file.string(), size_mm, ignored);
}

}  // namespace mrroc::drawing
