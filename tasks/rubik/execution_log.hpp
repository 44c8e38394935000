// The coordinator's record of a run, cycle by cycle.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "base/cube/move.hpp"
#include "tasks/rubik/coordinator.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {

/// One cycle: a turn of a face, or a re-grasp.
struct CycleRecord {
  Hand comes{}, leaves{};     ///< W, and the arm that lets go
  std::optional<Move> turn;   ///< none: the cube only changed hands
  std::int64_t begun{};       ///< macrostep in which the first free motion to it began
  std::int64_t ended{};       ///< macrostep in which the hand that let go had retreated
  std::int64_t turn_begun{};  ///< macrostep in which m = 5 began
  std::int64_t turn_ended{};  ///< and ended
  int grips{};                ///< attempts at m = 1..4
  int attempts{};             ///< attempts at m = 5
  bool done{};                ///< turn: m = 5 came to its end, the face is where it should be
  bool given_up{};            ///< the face jammed; it is turned the other way round in a later cycle
  double tool{};              ///< turned by the track arm's tool [rad]
  double travelled{};         ///< by the worker until it met the cube [m]
};
using ExecutionLog = std::vector<CycleRecord>;  ///< in the order of execution

}  // namespace mrroc::rubik
