// Sorts the stickers of a cube by colour.
#pragma once
#include <array>

#include "base/cube/cube_face.hpp"
#include "base/cube/facelets.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {

/// Parameters of the comparison of stickers; as in StateReadingParameters.
struct ColourSortingParameters {
  /// As in StateReadingParameters.
  double least_deviation{};
  double strange{};
};

/// All stickers of a cube, sorted.
struct SortedColours {
  std::array<int, kFacelets> face{};  ///< number of the face whose centre has the colour
  /// Of a facelet to each of the six colours: squared distance of the tints in variances, at most a bound; all 0 when
  /// nothing is known of the sticker.
  std::array<std::array<double, kFaces>, kFacelets> distance{};
  /// What the cheapest exchange of the facelet's colour with another facelet's would cost [variances], 0 when nothing is
  /// known of it.
  std::array<double, kFacelets> exchange{};
  std::array<bool, kFacelets> strange{};  ///< whether it differs too much from the others of its colour
  double centres{};  ///< least squared distance between two of the six colours [variances]
};

/// Centres are what their face is called after; the other 48 are assigned to them, eight of each, and the
/// colours become the means of their stickers, some times over.
/// @param stickers  by facelet; those of the centres without a flaw
[[nodiscard]] SortedColours sort_colours(const std::array<StickerReading, kFacelets>& stickers,
                                         const ColourSortingParameters& parameters);

}  // namespace mrroc::rubik
