#include "tasks/drawing/figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mrroc::drawing {
namespace {

// The strokes of one drawing, to be asked for distances. Empty strokes are nowhere.
class Strokes {
 public:
  explicit Strokes(const Drawing& drawing) {
    for (const Stroke& stroke : drawing)
      strokes_.push_back(stroke.empty() ? std::nullopt : std::optional<NearestPoint>(stroke));
  }

  [[nodiscard]] bool has(std::size_t s) const { return s < strokes_.size() && strokes_[s]; }
  [[nodiscard]] double distance(std::size_t s, const Point& p) const { return strokes_[s]->distance(p); }
  /// Distance to the nearest of all strokes, at most kMissingError.
  [[nodiscard]] double distance(const Point& p) const {
    double least = kMissingError;
    for (const auto& stroke : strokes_)
      if (stroke) least = std::min(least, stroke->distance(p));
    return least;
  }

 private:
  std::vector<std::optional<NearestPoint>> strokes_;
};

// Sums up errors.
struct Errors {
  double square{}, max{}, count{};

  void add(double error) {
    square += error * error;
    max = std::max(max, error);
    ++count;
  }
};

// Length for which sample k of a resampled stroke stands [mm].
double share(const Stroke& samples, std::size_t k) {
  if (samples.size() == 1) return kSampleSpacing;
  const double before = k > 0 ? (samples[k] - samples[k - 1]).norm() : 0;
  const double behind = k + 1 < samples.size() ? (samples[k + 1] - samples[k]).norm() : 0;
  return (before + behind) / 2;
}

}  // namespace

InkFigures compare(const Drawing& ink, const Drawing& reference, Align align) {
  InkFigures figures;
  if (align == Align::rigid) figures.alignment = best_alignment(ink, reference);
  Drawing moved = ink;
  for (Stroke& stroke : moved)
    for (Point& p : stroke) p = figures.alignment(p);
  const Strokes wanted(reference);
  const Strokes drawn(moved);
  Errors errors;

  for (std::size_t s = 0; s < moved.size(); ++s) {
    if (moved[s].empty()) continue;
    const bool extra = !wanted.has(s);
    if (extra) ++figures.strokes_extra;
    const Stroke samples = resampled(moved[s], kSampleSpacing);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double error = extra ? wanted.distance(samples[k]) : wanted.distance(s, samples[k]);
      errors.add(error);
      if (error > kStrayDistance && (extra || wanted.distance(samples[k]) > kStrayDistance))
        figures.stray_mm += share(samples, k);
    }
  }
  for (std::size_t s = 0; s < reference.size(); ++s) {
    if (reference[s].empty()) continue;
    const bool missing = !drawn.has(s);
    if (missing) ++figures.strokes_missing;
    const Stroke samples = resampled(reference[s], kSampleSpacing);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (missing) errors.add(kMissingError);
      if (missing || drawn.distance(s, samples[k]) > kStrayDistance)
        figures.uncovered_mm += share(samples, k);
    }
  }
  figures.rms_mm = errors.count > 0 ? std::sqrt(errors.square / errors.count) : 0;
  figures.max_mm = errors.max;
  return figures;
}

}  // namespace mrroc::drawing
