// A face of a Rubik's cube as a camera sees it: its geometry, and the reading of a virtual receptor.
//
// The frame of a seen face, G: origin in the middle of the face on its stickers, z out of the cube, x and y along the
// rows and columns of stickers. Seen from outside with y upwards, x points to the right, and stickers are numbered row
// by row from the upper left: 0 1 2 / 3 4 5 / 6 7 8. Which way up G lies on the face is not said by the face - after a
// quarter turn it looks the same - but by the hand that holds the cube (base/cube/face_view.hpp).
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "base/camera.hpp"

namespace mrroc {

inline constexpr int kStickers = 9;  ///< of one face

/// Lengths on the face.
struct CubeFaceShape {
  double edge{0.057};     ///< of the cube [m]
  double sticker{0.016};  ///< edge of a sticker [m], less than a third of the cube's

  /// @param k  0..8 @return the middle of sticker k in G [m]
  [[nodiscard]] Vector3 middle(int k) const {
    const int row = k / 3;
    const int column = k % 3;
    return {(column - 1) * edge / 3, (1 - row) * edge / 3, 0};
  }
};

/// The cube of the framework's tasks.
inline constexpr CubeFaceShape kCubeFace{};

/// Colours of the stickers, in the order of the faces U R F D L B that have them on a solved cube.
enum class StickerColour : std::uint8_t { white, red, green, yellow, orange, blue };
/// Number of these colours.
inline constexpr int kStickerColours = 6;
/// @return e.g. "white"
std::string_view to_string(StickerColour colour);

/// The tint of a colour as two numbers that tell colours apart whatever the light: coloured light shifts all of them
/// alike, brightness does not change them.
/// @param rgb  red, green, blue, 0..255
/// @return logarithms of red and of blue over green, all with a little grey added, as dark channels are mostly noise
std::array<double, 2> tint(const std::array<double, 3>& rgb);

/// Why the colour of a sticker is not to be relied on.
enum class StickerFlaw : std::uint8_t {
  none,
  hidden,   ///< an edge of it is not where it must be: something lies over it
  glaring,  ///< too much of it is as bright as the camera can tell
  dark,     ///< too little light to tell colours apart
  mixed,    ///< it shows more than one colour
};
/// @return e.g. "hidden"
std::string_view to_string(StickerFlaw flaw);

/// One sticker of a face.
struct StickerReading {
  /// Red, green, blue as the camera gives them, 0..255: the median over the sticker's inside without its glare. Zeros
  /// when nothing could be measured.
  std::array<double, 3> rgb{};
  /// How much light that the gloss mirrors, or that nothing explains, may still be in rgb [grey values].
  double deviation{};
  /// @return variances of its tint, if a light of a lamp's colour, as strong as the deviation, were in rgb
  [[nodiscard]] std::array<double, 2> tint_variance() const;
  /// What it is called under light of an unknown, not too strong tint; decided from this face alone. Which stickers of
  /// a cube have the same colour is better told by all six faces together (tasks/rubik/reading/state_reading.hpp).
  StickerColour colour{};
  double confidence{};  ///< probability that it is that colour, 0..1; 0 with a flaw
  StickerFlaw flaw{};   ///< none: the colour can be relied on
};

/// y_cV of the receptor: which face is shown, and in which light: every place has its own. Trivially copyable.
struct CubeFaceSetting {
  int face{-1};   ///< 0..5: U R F D L B; -1: none is shown
  int place{-1};  ///< number as CubeFaceReading::place, the only one that is looked at; -1: any

  friend bool operator==(const CubeFaceSetting&, const CubeFaceSetting&) = default;
};

/// Reading of the receptor r_cube_face from one picture. There is one for every picture, also when nothing
/// was seen.
struct CubeFaceReading {
  std::int64_t frame{};  ///< 0, 1, 2... of the camera
  std::int64_t step{};   ///< of the effector drivers at which the picture was taken
  bool seen{};           ///< a face lies at one of the places where faces are shown
  bool valid{};          ///< seen, and every sticker has a colour that can be relied on
  int place{-1};         ///< number of that place, in the alphabetical order of their names; -1: not seen
  Pose T_CG;             ///< face G in the camera C; identity when not seen
  Matrix6 covariance = Matrix6::Zero();  ///< of the error's components x y z [m], ax ay az [rad], along C
  double reprojection_px{};              ///< root mean square over the stickers' edges, across them [pixel]
  std::array<StickerReading, kStickers> stickers{};  ///< by number k as in CubeFaceShape::middle()
};

}  // namespace mrroc
