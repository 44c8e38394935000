// Features of a picture: corners, spread over it. Only for the sources of this folder.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "base/camera.hpp"

namespace mrroc::vsp {

/// The picture is divided into equal cells, so that one rich corner of the room does not take all features.
inline constexpr int kCellRows = 4, kCellColumns = 5;
/// Most features of a cell.
inline constexpr int kCellFeatures = 20;

/// @return corners of the brightness (Shi and Tomasi, 1994) [pixel], at most kCellFeatures in a cell, the best ones,
///         8 pixels apart within their cell
std::vector<Vector2> corners(const cv::Mat& grey);

/// @param size  of the picture @return number of the cell in which a place of the picture lies, row by row
int cell_of(const Vector2& place, const cv::Size& size);

}  // namespace mrroc::vsp
