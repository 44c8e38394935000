// The cube and the grippers that hold it, as cameras see them.
#pragma once
#include <vector>

#include "base/cube/cube_face.hpp"
#include "sim/camera/scene.hpp"
#include "sim/cube.hpp"
#include "sim/gripper_body.hpp"

namespace mrroc::sim {

/// Material of stickers: an even colour under a clear gloss, which a lamp makes glare in its mirror image.
struct StickerLook {
  /// Of the faces U R F D L B, in the order of StickerColour: share of the light that is reflected.
  std::array<camera::Colour, kStickerColours> colours{{{0.86, 0.86, 0.84},
                                                       {0.68, 0.06, 0.07},
                                                       {0.05, 0.52, 0.19},
                                                       {0.84, 0.76, 0.07},
                                                       {0.90, 0.36, 0.06},
                                                       {0.05, 0.19, 0.58}}};
  camera::Colour plastic{0.035, 0.035, 0.04};  ///< of the pieces
  double shine{0.8};                           ///< strength of the mirror image
  double gloss{15000};                         ///< its sharpness (camera::Body)
};

/// Adds the 26 pieces and 54 stickers, every layer as far turned as it is.
void add_cube(std::vector<camera::Body>& bodies, const CubeTruth& truth,
              const CubeFaceShape& shape = kCubeFace, const StickerLook& look = {});

/// Adds palm, fingers and pads where they are.
/// @param jaws  distance between the pads [m]
void add_gripper(std::vector<camera::Body>& bodies, const GripperBodyParameters& gripper, const Pose& T_UE,
                 double jaws);

}  // namespace mrroc::sim
