// Virtual receptor of a face of the cube: nine colours from one picture of a face that is held before the camera.
#pragma once
#include <vector>

#include "base/cube/cube_face.hpp"
#include "base/image.hpp"

namespace mrroc::vsp {

/// Thresholds of the receptor.
struct CubeFaceParameters {
  double place_error{0.006};  ///< by which a face may be off its place, along each axis [m]
  double angle_error{0.06};   ///< likewise, about each axis [rad]
  double contrast{6};         ///< least change from the black plastic to a sticker at its edge [grey levels]
  double rms_px{0.6};         ///< no face is delivered whose reprojection error is larger [pixel]
  double edge_share{
      0.6};  ///< of every edge of a sticker must be where it has to be, or the sticker is hidden
  double glare_share{0.67};  ///< largest part of a sticker that may be as bright as the camera can tell
  double dark{8};            ///< least brightness of the brightest channel of a sticker [grey levels]

  double veil{
      0.1};  ///< largest share of mirrored light in the colours of a valid reading (StickerReading::deviation)
  double confidence{0.95};  ///< least one of every sticker of a valid reading
};

/// Looks for one face at the places where faces are shown, which the arm that holds the cube is told, too. The arm
/// knows the place to some millimetres and degrees; the edges of the stickers tell it more exactly. Colours are taken
/// from the insides of the stickers.
class CubeFaceSensor {
 public:
  /// @param places  T_CG, frame G of base/cube/cube_face.hpp; farther apart than the errors above
  /// @throws FaultError bad_configuration: the camera is not proper, there is no place, or a face there would not be in
  ///         the picture or would be seen at more than 60 degrees
  CubeFaceSensor(const CameraModel& camera, std::vector<Pose> places,
                 const CubeFaceParameters& parameters = {}, const CubeFaceShape& shape = kCubeFace);

  /// A function of the picture and the place alone. @param picture  3 channels, of the camera's size; anything else shows
  /// nothing @param place  the only one to look at; one that there is not: all of them
  [[nodiscard]] CubeFaceReading detect(const ImageView& picture, std::int64_t frame, std::int64_t step,
                                       int place = -1) const;

 private:
  CameraModel camera_;
  std::vector<Pose> places_;
  CubeFaceParameters k_;
  CubeFaceShape shape_;
};

}  // namespace mrroc::vsp
