// Which poses the arms take so that a camera sees the board, and whose turn each of them is.
#pragma once
#include <cstddef>
#include <vector>

namespace mrroc::calibrate_cell {

/// The arm with the camera in its hand, and the one with the board.
inline constexpr std::size_t kCameraArm = 0, kBoardArm = 1;

/// Least number of pictures with a board in one turn.
inline constexpr std::size_t kLeastViews = 8;

/// Turns of the arms, in their order: one arm moves, the other one waits for its own. Those that only lead from one place to
/// the next have no poses of their own.
enum class Turn : int {
  show = 1,   ///< the board is moved before the camera in the hand
  look,       ///< the camera is moved before the board
  rise,       ///< the camera's arm is above what stands between the arms
  present,    ///< the board is moved before the cameras that stand alone
  leave,      ///< the board is back
  make_room,  ///< the camera's arm has been aside meanwhile
  touch,      ///< an arm touches the balls; that of the next arm has the next number
};

/// Poses that an arm takes in one turn.
struct Views {
  Turn turn{};
  std::vector<double> from;                 ///< joints in which it waits for the turn [rad], track [m]
  std::vector<std::vector<double>> joints;  ///< of each pose; may be empty

  friend bool operator==(const Views&, const Views&) = default;
};

/// What an arm does for the pictures: its turns, in their order; none without pictures.
using ViewPlan = std::vector<Views>;

}  // namespace mrroc::calibrate_cell
