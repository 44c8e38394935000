// Locates a face of the cube exactly: finds its stickers' edges in the picture, and the pose that explains
// them. Only for the sources of this folder.
#pragma once
#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "vsp/cube_face/cube_face_sensor.hpp"

namespace mrroc::vsp {

/// A face that was found.
struct FoundFace {
  Pose T_CG;                             ///< face G in the camera C
  Matrix6 covariance = Matrix6::Zero();  ///< as in CubeFaceReading
  double rms_px{};                       ///< over the edges' points that support the pose [pixel]
  std::array<bool, kStickers> whole{};   ///< whether all four edges of the sticker are where they must be
};

/// Searches along the normals of the stickers' edges for the change from the sticker to the black plastic, and
/// minimises the distances of the edges together with what is known of the place beforehand (maximum a posteriori,
/// Gauss-Newton with Tukey's weights). The reach begins with the place's error, which is less than half a
/// sticker, so no edge is taken for its neighbour's.
/// @param bright  of every pixel its brightest channel, 8 bits
/// @param place   T_CG as the arm has it
/// @return nothing when fewer than five stickers are whole, or the error is too large
std::optional<FoundFace> find_face(const cv::Mat& bright, const CameraModel& camera, const Pose& place,
                                   const CubeFaceShape& shape, const CubeFaceParameters& k);

}  // namespace mrroc::vsp
