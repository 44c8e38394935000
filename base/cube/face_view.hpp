// Relates a face that is shown to a camera to the facelets of the cube.
#pragma once
#include <array>

#include "base/cube/cube.hpp"
#include "base/cube/cube_face.hpp"
#include "base/pose.hpp"

namespace mrroc::cube {

/// Which face is shown, and which way up.
struct ShownFace {
  /// Which one, by the colour of its centre.
  Face face{Face::U};
  /// Quarter turns clockwise, seen from outside, from the face as facelets are written (base U R F D L B, U with B
  /// above, D with F above, the others with U above) to the face as it is shown: with 1, what is written at the top is
  /// seen at the right. 0 to 3.
  int quarters{};
  friend constexpr bool operator==(const ShownFace&, const ShownFace&) = default;
};

/// Frame of a face as facelets are written: x to the right, y up, z out of it, in the frame C of the cube
/// (x out of R, y out of B, z out of U; sim/cube.hpp).
[[nodiscard]] Matrix3 facelet_frame(Face face);

/// @param R_GC  orientation of the cube in the frame G of the shown face (base/cube/cube_face.hpp), e.g.
///              (T_UE T_EG)^-1 T_UE T_EC for a cube in a hand: any rotation, the nearest of the 24 is meant
[[nodiscard]] ShownFace shown_face(const Matrix3& R_GC);

/// @param sticker  of the picture, 0 to 8 @return number of its facelet, 0 to 53
[[nodiscard]] int facelet(ShownFace shown, int sticker);

/// One face of a cube as it was read.
struct FaceView {
  ShownFace shown;                                   ///< which face it was, as the arms held it
  std::array<StickerReading, kStickers> stickers{};  ///< as in CubeFaceReading
};

/// @param R_GC  as for shown_face()
/// @return the face as the receptor has read it; of a face that was not seen every sticker is hidden
[[nodiscard]] FaceView view_of(const Matrix3& R_GC, const CubeFaceReading& reading);

}  // namespace mrroc::cube
