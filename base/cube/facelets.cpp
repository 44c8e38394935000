#include "base/cube/facelets.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "base/cube/character.hpp"
#include "base/cube/vocabulary.hpp"
#include "base/fault.hpp"

namespace mrroc::cube {
namespace {

constexpr int kPerFace = 9;
constexpr int kCentre = 4;

template <std::size_t M>
std::string name_of(const std::array<Face, M>& faces) {
  std::string name;
  for (const Face f : faces) name += letter(f);
  return name;
}

/// @return "U3" for facelet 2
std::string facelet_name(int facelet) {
  return fmt::format("{}{}", kFaceLetters[facelet / kPerFace], facelet % kPerFace + 1);
}

FaceletReading broken(CubeRule rule, std::string text) { return {std::nullopt, rule, std::move(text)}; }

/// @return "'X', no letter of URFDLB", of the character at a byte
std::string no_letter(std::string_view facelets, std::size_t k) {
  return fmt::format("'{}', no letter of {}", character_at(facelets, k), kFaceLetters);
}

/// Rules that the letters alone can break.
FaceletReading check_letters(std::string_view facelets) {
  const std::size_t wrong = facelets.find_first_not_of(kFaceLetters);
  const std::size_t before = characters(facelets.substr(0, wrong));
  if (const std::size_t count = characters(facelets); count != kFacelets) {
    std::string text = fmt::format("{} facelets instead of {}", count, kFacelets);
    if (wrong != std::string_view::npos)
      text += fmt::format("; number {} is {}", before + 1, no_letter(facelets, wrong));
    return broken(CubeRule::length, text);
  }
  if (wrong != std::string_view::npos)
    return broken(CubeRule::letter,
                  fmt::format("facelet {}, number {}, is {}", facelet_name(static_cast<int>(before)),
                              before + 1, no_letter(facelets, wrong)));
  for (int f = 0; f < kFaces; ++f)
    if (facelets[kPerFace * f + kCentre] != kFaceLetters[f])
      return broken(CubeRule::centre, fmt::format("the centre of face {} is {}", kFaceLetters[f],
                                                  facelets[kPerFace * f + kCentre]));
  for (const char c : kFaceLetters)
    if (const auto n = std::ranges::count(facelets, c); n != kPerFace)
      return broken(CubeRule::count,
                    fmt::format("colour {} is there {} times instead of {}", c, n, kPerFace));
  return {};
}

/// Finds which piece shows the colours of each slot.
/// @param values  receives piece * M + turn
template <std::size_t N, std::size_t M>
FaceletReading find_pieces(std::string_view facelets, const std::array<std::array<Face, M>, N>& pieces,
                           const std::array<std::array<std::uint8_t, M>, N>& stickers, std::string_view kind,
                           std::array<std::uint8_t, N>& values) {
  std::array<int, N> slot_of;
  slot_of.fill(-1);
  for (std::size_t slot = 0; slot < N; ++slot) {
    std::string colours;
    for (const std::uint8_t k : stickers[slot]) colours += facelets[k];
    const auto shows = [&](std::size_t piece, std::size_t turn) {
      for (std::size_t j = 0; j < M; ++j)
        if (colours[(j + turn) % M] != letter(pieces[piece][j])) return false;
      return true;
    };
    int found = -1;
    for (std::size_t value = 0; value < N * M; ++value)
      if (shows(value / M, value % M)) found = static_cast<int>(value);
    if (found < 0)
      return broken(CubeRule::piece,
                    fmt::format("the {} at {} ({}) would have the colours {}, and there is no such piece",
                                kind, name_of(pieces[slot]), facelet_name(stickers[slot][0]), colours));
    const std::size_t piece = static_cast<std::size_t>(found) / M;
    if (slot_of[piece] >= 0)
      return broken(CubeRule::duplicate,
                    fmt::format("the {} {} is there twice, at {} and at {}", kind, name_of(pieces[piece]),
                                name_of(pieces[slot_of[piece]]), name_of(pieces[slot])));
    slot_of[piece] = static_cast<int>(slot);
    values[slot] = static_cast<std::uint8_t>(found);
  }
  return {};
}

}  // namespace

std::string_view to_string(CubeRule rule) {
  static constexpr std::array<std::string_view, 10> kNames{
      "none", "length", "letter", "centre", "count", "piece", "duplicate", "twist", "flip", "parity"};
  return kNames[static_cast<std::size_t>(rule)];
}

FaceletReading read_facelets(std::string_view text) {
  std::string facelets;
  std::ranges::copy_if(text, std::back_inserter(facelets),
                       [](char c) { return kBlanks.find(c) == std::string_view::npos; });
  Cube cube;
  FaceletReading reading = check_letters(facelets);
  if (reading.broken == CubeRule::none)
    reading = find_pieces(facelets, kCornerFaces, kCornerFacelets, "corner", cube.corners);
  if (reading.broken == CubeRule::none)
    reading = find_pieces(facelets, kEdgeFaces, kEdgeFacelets, "edge", cube.edges);
  if (reading.broken != CubeRule::none) return reading;
  if (const int twist = twist_sum(cube); twist != 0)
    return broken(
        CubeRule::twist,
        fmt::format("the corners' twists sum up to {} thirds of a turn: one corner is twisted", twist));
  if (flip_sum(cube) != 0)
    return broken(CubeRule::flip, "an odd number of edges is flipped: one edge is the wrong way round");
  if (odd_corners(cube) != odd_edges(cube))
    return broken(CubeRule::parity, "corners and edges have different parity: two pieces are exchanged");
  reading.cube = cube;
  return reading;
}

Cube cube_from_facelets(std::string_view facelets) {
  const FaceletReading reading = read_facelets(facelets);
  if (!reading.cube)
    throw FaultError(kBadCube,
                     fmt::format("the rule '{}' is broken: {}", to_string(reading.broken), reading.text));
  return *reading.cube;
}

std::string to_facelets(const Cube& cube) {
  std::string facelets(kFacelets, ' ');
  for (int f = 0; f < kFaces; ++f) facelets[kPerFace * f + kCentre] = kFaceLetters[f];
  for (int k = 0; k < kCorners; ++k)
    for (int j = 0; j < 3; ++j)
      facelets[kCornerFacelets[k][(j + cube.corners[k] % 3) % 3]] =
          letter(kCornerFaces[cube.corners[k] / 3][j]);
  for (int k = 0; k < kEdges; ++k)
    for (int j = 0; j < 2; ++j)
      facelets[kEdgeFacelets[k][(j + cube.edges[k] % 2) % 2]] = letter(kEdgeFaces[cube.edges[k] / 2][j]);
  return facelets;
}

}  // namespace mrroc::cube
