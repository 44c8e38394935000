// Reads the state of the cube from pictures of its six faces.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/cube/face_view.hpp"
#include "base/cube/facelets.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {

/// Readings of all faces before a cube that cannot be is a fault, each at a place of its own.
inline constexpr int kReadings = 2;

/// When a sticker counts as ambiguous, and how many of them may be completed.
struct StateReadingParameters {
  /// Least cost, in variances, that any exchange of the sticker's colour for another one must have.
  double margin{16};
  double least_deviation{0.12};  ///< standard deviation of the tints (base/cube/cube_face.hpp) of one colour
  double strange{36};            ///< variances by which a sticker may differ from the others of its colour
  int most_completed{6};         ///< stickers without a certain colour that the rules of the cube may decide
};

/// Result of reading six faces.
struct StateReading {
  std::optional<Cube> cube;  ///< nothing when no cube, or more than one, agrees with what was read
  std::string facelets;  ///< 54 letters of URFDLB by the centres that have the same colour; '?': undecided
  /// Of each facelet, 0..1: 1 - exp(-c/2) with c the cost, in variances, of its cheapest exchange for another colour.
  std::array<double, kFacelets> confidence{};
  std::vector<int> completed;  ///< facelets whose colour the rules of the cube decided, in ascending order
  CubeRule broken{CubeRule::none};  ///< the rule that the facelets break; none when they are merely undecided
  std::string text;  ///< what is wrong or was completed, naming facelets; empty when all was certain
};

/// Sorts 54 stickers by colour without knowing the light: stickers that look like a centre have its colour, nine of
/// each, by the assignment of least cost (Kuhn, 1955). Then the rules of the cube are checked. Stickers with a
/// flaw or whose colour is ambiguous get the one that makes a possible cube, if there is exactly one such way.
/// @param views  the six faces in any order; of a face that is there more often, as after another look at it, every
///               sticker counts where it is seen best
/// @throws std::invalid_argument  a face is missing. Allocates; not for the servo step
[[nodiscard]] StateReading read_state(std::span<const FaceView> views,
                                      const StateReadingParameters& parameters = {});

}  // namespace mrroc::rubik
