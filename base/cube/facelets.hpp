// The cube as 54 facelets, and the rules that a cube has to keep.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/cube/cube.hpp"

namespace mrroc::cube {

inline constexpr int kFacelets = 54;  ///< 9 of each face

/// Facelet numbers of the stickers of each corner slot, in the order of kCornerFaces.
inline constexpr std::array<std::array<std::uint8_t, 3>, kCorners> kCornerFacelets{{{8, 9, 20},
                                                                                    {6, 18, 38},
                                                                                    {0, 36, 47},
                                                                                    {2, 45, 11},
                                                                                    {29, 26, 15},
                                                                                    {27, 44, 24},
                                                                                    {33, 53, 42},
                                                                                    {35, 17, 51}}};
/// Facelet numbers of the stickers of each edge slot, in the order of kEdgeFaces.
inline constexpr std::array<std::array<std::uint8_t, 2>, kEdges> kEdgeFacelets{{{5, 10},
                                                                                {7, 19},
                                                                                {3, 37},
                                                                                {1, 46},
                                                                                {32, 16},
                                                                                {28, 25},
                                                                                {30, 43},
                                                                                {34, 52},
                                                                                {23, 12},
                                                                                {21, 41},
                                                                                {50, 39},
                                                                                {48, 14}}};

/// The rules of a cube, in the order in which they are looked at.
enum class CubeRule : std::uint8_t {
  none,       ///< nothing is broken
  length,     ///< there are 54 facelets
  letter,     ///< each is one of URFDLB, the face on whose centre its colour is
  centre,     ///< the centre of each face has the face's letter
  count,      ///< there are nine of each colour
  piece,      ///< every corner and edge has colours that a piece has
  duplicate,  ///< every piece is there once
  twist,      ///< the corners' twists sum up to full turns
  flip,       ///< an even number of edges is flipped
  parity      ///< corners and edges are permuted both evenly or both oddly
};

/// @return the rule's name, e.g. "twist"
[[nodiscard]] std::string_view to_string(CubeRule rule);

/// Result of reading facelets.
struct FaceletReading {
  std::optional<Cube> cube;         ///< nothing when a rule is broken
  CubeRule broken{CubeRule::none};  ///< the first rule that is broken
  std::string text;                 ///< what is wrong, naming facelet, piece or colour; empty when nothing is
};

/// Reads facelets in the order U R F D L B, each face row by row as seen from outside: U with B above, D with F
/// above, the others with U above.
/// @param text  54 letters of URFDLB; blanks and ends of lines between them do not count
[[nodiscard]] FaceletReading read_facelets(std::string_view text);
/// @return the cube of valid facelets @throws FaultError bad_cube, with the text of the reading
[[nodiscard]] Cube cube_from_facelets(std::string_view facelets);
/// @return the 54 facelets in the same order
[[nodiscard]] std::string to_facelets(const Cube& cube);

}  // namespace mrroc::cube
