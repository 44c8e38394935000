// Where a tag is looked for, and how finely. Only for the sources of this folder and its tests.
#pragma once
#include <opencv2/core.hpp>

#include "vsp/apriltag/border.hpp"

namespace mrroc::vsp {

/// @return the part of the whole picture that reaches half of the tag's size beyond it, at least 24 pixels
cv::Rect part_around(const Corners& corners, const cv::Rect& whole);

/// @param grey      at least 3 pixels wide
/// @param blur      before edges are counted [pixel]
/// @param contrast  of an edge, over two pixels along a row [grey levels]
/// @return whether more than a tenth of the pixels are on an edge, as in a picture of noise or a texture. It is searched at
///         half the resolution, since the work grows with the edges.
bool is_cluttered(const cv::Mat& grey, double blur, int contrast);

}  // namespace mrroc::vsp
