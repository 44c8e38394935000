// The reading of a pen's virtual sensor (MS fig. 3).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace mrroc {

/// State of the pen-state automaton (MS fig. 3, (28)), in the order in which a stroke passes through it:
/// above_paper -> lowering -> paper_surface -> lift_off -> above_paper. Only paper_surface leaves ink.
enum class PenState : std::uint8_t {
  above_paper,    ///< the pen is in the air
  lowering,       ///< the pen moves down fast enough to be on its way to the paper
  paper_surface,  ///< the pen has hit the paper and has not been lifted since
  lift_off        ///< the pen has been pulled off the paper; lasts one step of the sensor
};

/// Every pen state, in the order of its number.
inline constexpr std::array kPenStates{PenState::above_paper, PenState::lowering, PenState::paper_surface,
                                       PenState::lift_off};

/// @return the state's name as in the code, for files and messages; "?" for a number that is none. Real-time
/// safe.
constexpr std::string_view to_string(PenState s) {
  switch (s) {
    case PenState::above_paper:
      return "above_paper";
    case PenState::lowering:
      return "lowering";
    case PenState::paper_surface:
      return "paper_surface";
    case PenState::lift_off:
      return "lift_off";
  }
  return "?";
}

/// @return the state with that name (the inverse of to_string), or nothing. Real-time safe.
constexpr std::optional<PenState> pen_state_named(std::string_view name) {
  for (const PenState s : kPenStates)
    if (to_string(s) == name) return s;
  return std::nullopt;
}

}  // namespace mrroc
