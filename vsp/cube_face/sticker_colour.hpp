// Classifies the colour of a sticker, and names colours. Only for the sources of this folder.
#pragma once
#include <array>
#include <opencv2/core.hpp>

#include "vsp/cube_face/cube_face_sensor.hpp"

namespace mrroc::vsp {

/// Measures the inside of a sticker in 3 x 3 parts. Light that is mirrored by the gloss adds to all channels, so the
/// least bright parts show the colour best; parts that differ from them in another way are another colour.
/// @param colours  the picture, blue, green, red
/// @param sticker  0..8 of a face at T_CG
/// @return rgb, deviation and flaw; neither name nor confidence
StickerReading measure_sticker(const cv::Mat& colours, const CameraModel& camera, const Pose& T_CG,
                               const CubeFaceShape& shape, int sticker, const CubeFaceParameters& k);

/// Gives names and confidences to the stickers of a face that have no flaw. The light's tint is not known: every tint
/// has a probability, the more the less it is, and with each the stickers have probable names; what is delivered are the
/// probabilities over all tints.
void name_colours(std::array<StickerReading, kStickers>& stickers);

}  // namespace mrroc::vsp
