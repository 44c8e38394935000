#include "base/cube/move.hpp"

#include <fmt/core.h>

#include <numeric>
#include <utility>

#include "base/cube/character.hpp"
#include "base/cube/vocabulary.hpp"
#include "base/fault.hpp"

namespace mrroc::cube {
namespace {

Cube quarter_turn(Face face) {
  const Symmetry rotation = rotation_about(face);
  const auto contains = [face](const auto& faces) { return std::ranges::find(faces, face) != faces.end(); };
  Cube c;
  for (int k = 0; k < kCorners; ++k)
    if (contains(kCornerFaces[k]))
      c.corners[rotation.corner[k]] = static_cast<std::uint8_t>(3 * k + rotation.corner_offset[k]);
  for (int k = 0; k < kEdges; ++k)
    if (contains(kEdgeFaces[k]))
      c.edges[rotation.edge[k]] = static_cast<std::uint8_t>(2 * k + rotation.edge_offset[k]);
  return c;
}

std::array<Cube, kMoves> make_turns() {
  std::array<Cube, kMoves> turns;
  for (int f = 0; f < kFaces; ++f) {
    const Cube quarter = quarter_turn(static_cast<Face>(f));
    turns[3 * f] = quarter;
    turns[3 * f + 1] = quarter * quarter;
    turns[3 * f + 2] = quarter * quarter * quarter;
  }
  return turns;
}

/// @return a number from 0 to below end, the same on every machine
int draw(int end, std::mt19937_64& random) {
  const auto n = static_cast<std::uint64_t>(end);
  const std::uint64_t limit = std::mt19937_64::max() - std::mt19937_64::max() % n;
  std::uint64_t value = random();
  while (value >= limit) value = random();
  return static_cast<int>(value % n);
}

template <std::size_t N>
void shuffle(std::array<std::uint8_t, N>& pieces, std::mt19937_64& random) {
  for (int k = static_cast<int>(N) - 1; k > 0; --k) std::swap(pieces[k], pieces[draw(k + 1, random)]);
}

}  // namespace

const Cube& turn(Move m) {
  static const std::array<Cube, kMoves> turns = make_turns();
  return turns[m.index];
}

Cube after(Cube cube, const Moves& moves) {
  for (const Move m : moves) cube = cube * turn(m);
  return cube;
}

Moves inverse(const Moves& moves) {
  Moves result;
  for (std::size_t k = moves.size(); k-- > 0;) result.push_back(moves[k].inverse());
  return result;
}

Move conjugate(Move m, const Symmetry& s) {
  return {s.faces[number(m.face())], s.mirrored ? 4 - m.quarters() : m.quarters()};
}

std::string to_string(Move m) {
  static constexpr std::array<std::string_view, 3> kSuffix{"", "2", "'"};
  return fmt::format("{}{}", letter(m.face()), kSuffix[m.quarters() - 1]);
}

std::string to_string(const Moves& moves) {
  std::string text;
  for (const Move m : moves) text += (text.empty() ? "" : " ") + to_string(m);
  return text;
}

Moves parse_moves(std::string_view text) {
  Moves moves;
  std::size_t k = 0;
  const auto here = [&] { return k < text.size() ? character_at(text, k) : std::string_view(); };
  const auto take = [&](bool wanted) {
    if (wanted) k += here().size();
    return wanted;
  };
  while (k < text.size()) {
    if (take(here() == "," || kBlanks.find(text[k]) != std::string_view::npos)) continue;
    const std::size_t face = kFaceLetters.find(text[k]);
    if (face == std::string_view::npos)
      throw FaultError(
          kBadCube, fmt::format("'{}' at character {} is no turn", here(), characters(text.substr(0, k)) + 1),
          "write turns as U, R, F, D, L or B, with 2 or ' behind it where needed");
    ++k;
    int quarters = 1;
    if (take(here() == "2"))
      quarters = 2;
    else if (take(here() == "3"))
      quarters = 3;
    if (take(is_apostrophe(here()))) quarters = 4 - quarters;
    moves.emplace_back(static_cast<Face>(face), quarters);
  }
  return moves;
}

Cube random_cube(std::mt19937_64& random) {
  std::array<std::uint8_t, kCorners> corner;
  std::array<std::uint8_t, kEdges> edge;
  std::iota(corner.begin(), corner.end(), std::uint8_t{0});
  std::iota(edge.begin(), edge.end(), std::uint8_t{0});
  shuffle(corner, random);
  shuffle(edge, random);
  Cube cube;
  for (int k = 0, twist = 0; k < kCorners; ++k) {
    const int t = k < kCorners - 1 ? draw(3, random) : (3 - twist % 3) % 3;
    twist += t;
    cube.corners[k] = static_cast<std::uint8_t>(3 * corner[k] + t);
  }
  for (int k = 0, flip = 0; k < kEdges; ++k) {
    const int f = k < kEdges - 1 ? draw(2, random) : flip % 2;
    flip += f;
    cube.edges[k] = static_cast<std::uint8_t>(2 * edge[k] + f);
  }
  // Half of the assemblies have permutations of different parity; an exchange of two edges is a bijection
  // between the halves.
  if (odd_corners(cube) != odd_edges(cube)) std::swap(cube.edges[0], cube.edges[1]);
  return cube;
}

Moves random_moves(int count, std::mt19937_64& random) {
  Moves moves;
  while (static_cast<int>(moves.size()) < count) {
    const Move m(draw(kMoves, random));
    if (may_follow(moves.empty() ? nullptr : &moves.back(), m)) moves.push_back(m);
  }
  return moves;
}

}  // namespace mrroc::cube
