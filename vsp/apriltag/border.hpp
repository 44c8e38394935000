// Locates the edges of a tag's black border to a fraction of a pixel. Only for the sources of this folder.
#pragma once
#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "base/camera.hpp"

namespace mrroc::vsp {

/// Corners of a quadrangle [pixel], neighbours in the array are neighbours in the picture.
using Corners = std::array<Vector2, 4>;

/// A tag's border as located by its edges.
struct Border {
  Corners corners;  ///< where the lines through the edges meet [pixel]
  double sigma{};   ///< standard deviation of the corners, from the scatter along the edges [pixel]
  double blur{};    ///< the largest of the edges' blurs, standard deviation [pixel]
};

/// Locates the change from dark to light on many lines across every edge, and lays a line through the middle of each
/// edge. Points that lie off are left out.
/// @param grey   a picture without distortion, one channel
/// @param rough  corners to within a pixel or two
/// @return nothing when an edge cannot be seen along most of its length
std::optional<Border> locate_border(const cv::Mat& grey, const Corners& rough);

}  // namespace mrroc::vsp
