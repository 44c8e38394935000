// Measures how well ink follows the drawing.
#pragma once
#include "tasks/drawing/strokes.hpp"

namespace mrroc::drawing {

inline constexpr double kSampleSpacing = 0.2;  ///< of the ink points that are judged [mm]
inline constexpr double kStrayDistance = 1.5;  ///< ink farther than this from every stroke is stray [mm]
/// The error that a missing stroke is given at each of its points [mm]: the sheet's diagonal, so that the
/// figures stay finite but cannot be taken for good.
inline constexpr double kMissingError = 282.8;

/// A motion of the sheet's plane that is never mirrored and never scaled: first a turn about the origin, then
/// a shift.
struct Rigid {
  double turn{};      ///< counter-clockwise [rad]
  Point shift{0, 0};  ///< [mm]

  [[nodiscard]] Point operator()(const Point& p) const { return Eigen::Rotation2Dd(turn) * p + shift; }
};

/// Alignment of ink before it is measured.
enum class Align {
  none,  ///< not at all: teach-in, ink against the input drawing
  rigid  ///< by the rigid motion with the least sum of squared errors: copies, ink against the taught ink
};

/// Ink against a reference, stroke by stroke. Strokes correspond by their number.
struct InkFigures {
  double rms_mm{};        ///< root mean square distance of the ink from its stroke of the reference
  double max_mm{};        ///< largest such distance
  double stray_mm{};      ///< length of ink farther than kStrayDistance from every stroke of the reference
  double uncovered_mm{};  ///< length of the reference farther than kStrayDistance from the ink of its stroke
  int strokes_missing{};  ///< strokes of the reference without ink; each point of them counts kMissingError
  int strokes_extra{};    ///< strokes of ink beyond the reference's; they count by the nearest of all strokes
  Rigid alignment;        ///< what was applied to the ink
};

/// Judges ink. Both are resampled at kSampleSpacing; a distance is that to the nearest point of the polyline.
/// A dot of stray ink counts one spacing.
/// @param ink  strokes in the order of drawing [mm], see strokes_of()
/// @param reference  what they should be [mm]
[[nodiscard]] InkFigures compare(const Drawing& ink, const Drawing& reference, Align align);

/// @return the rigid motion that brings the ink nearest to the reference: the sum of squared distances of the
/// ink from the strokes with the same number is least. Found by closest-point iteration from two starts,
/// equal shares of the strokes' lengths and no motion at all, of which the better end is taken. No motion if
/// no stroke has a counterpart.
[[nodiscard]] Rigid best_alignment(const Drawing& ink, const Drawing& reference);

}  // namespace mrroc::drawing
