// The state automaton of an effector driver: one table gives the transition for every event in every state.
// The driver runs on it, docs/automaton.md is made from it.
#pragma once
#include <array>
#include <cstddef>
#include <string_view>

#include "base/effector_command.hpp"
#include "edp/state_table.hpp"

namespace mrroc::edp {

/// Events of a driver. The first ones are what commands ask for, and may be refused; a command that
/// asks for several things is refused when one of them is. The last ones happen by themselves. QUERY is legal
/// in every state and changes none, so it is no event.
enum class Event : std::uint8_t {
  get,              ///< GET, also as part of SET_GET
  arm,              ///< SET ARM, unless it is a jog
  jog,              ///< SET ARM, MIM with relative motor positions: it needs no synchronisation
  tool,             ///< SET ROBOT_MODEL TOOL
  kinematic_model,  ///< SET ROBOT_MODEL KINEMATIC_MODEL
  servo_algorithm,  ///< SET ROBOT_MODEL SERVO_ALGORITHM
  force_tool,       ///< SET ROBOT_MODEL FORCE_TOOL, force_bias
  outputs,          ///< SET OUTPUTS
  synchro,          ///< SYNCHRO
  reset,            ///< reset of an arm whose position is known
  reset_unknown,    ///< reset of an arm whose position is not known
  homed,            ///< homing has found all positions
  abandoned,        ///< nobody owns the driver any more: released, dead, or stopped
  silence,          ///< a macrostep begins without SET ARM
  failed,           ///< the macrostep cannot be executed to its end
  stood,            ///< the set point has come to rest
  trip,             ///< a malfunction
};
/// Number of events.
inline constexpr std::size_t kEvents = 17;
/// Events before this one are asked for by commands, the others happen by themselves.
inline constexpr Event kFirstOwnEvent = Event::homed;

/// One row of the table: a state and what every event leads to, in the order of Event.
using StateRow = BasicStateRow<Event, kEvents>;

/// Row k describes the state with the number k. What is not said is illegal_in_state. Whatever the state, a
/// malfunction leads to faulted, and a reset of an arm that is not faulted changes nothing.
inline constexpr std::array<StateRow, kDriverStates> kAutomaton = [] {
  using enum DriverState;
  using enum Event;
  using F = FaultCode;
  using Row = table::BasicRow<Event, kEvents>;
  const auto any = [](DriverState s) {
    return Row(s).go(faulted, trip).stay(reset, reset_unknown, abandoned);
  };
  const auto standing = [any](DriverState s) {
    return any(s)
        .stay(get, tool, kinematic_model, servo_algorithm, force_tool, outputs, silence)
        .go(executing, arm, jog);
  };
  const auto moving = [any](DriverState s) {
    return any(s)
        .stay(get, tool, servo_algorithm, outputs)
        .go(executing, arm, jog)
        .refuse(F::not_at_rest, kinematic_model, force_tool);
  };
  return std::array<StateRow, kDriverStates>{
      any(not_synchronised)
          .stay(get, servo_algorithm, outputs, silence)
          .go(jogging, jog)
          .go(homing, synchro)
          .refuse(F::not_synchronised, arm, tool, kinematic_model, force_tool),
      any(homing).stay(get, outputs, silence).go(ready, homed).go(jogging, abandoned),
      standing(ready),
      moving(executing).go(decelerating, silence, failed),
      moving(decelerating).stay(silence).go(holding, stood),
      standing(holding),
      any(faulted)
          .stay(silence)
          .go(ready, reset)
          .go(not_synchronised, reset_unknown)
          .refuse(F::reset_required, get, arm, jog, tool, kinematic_model, servo_algorithm, force_tool,
                  outputs, synchro),
      any(jogging)
          .stay(get, servo_algorithm, outputs, jog, silence, failed)
          .go(not_synchronised, stood)
          .refuse(F::not_synchronised, arm, tool, kinematic_model, force_tool)
          .refuse(F::not_at_rest, synchro),
  };
}();

static_assert(table::is_in_order(kAutomaton));

/// @return what an event leads to. Real-time safe
constexpr const Transition& transition(DriverState state, Event event) noexcept {
  return kAutomaton[static_cast<std::size_t>(state)].on[static_cast<std::size_t>(event)];
}

/// @return name of an event, for documents
constexpr std::string_view to_string(Event event) noexcept {
  constexpr std::array<std::string_view, kEvents> kNames{"GET",
                                                         "SET ARM",
                                                         "SET ARM, MIM relative motors",
                                                         "TOOL",
                                                         "KINEMATIC_MODEL",
                                                         "SERVO_ALGORITHM",
                                                         "FORCE_TOOL, force_bias",
                                                         "OUTPUTS",
                                                         "SYNCHRO",
                                                         "reset, position known",
                                                         "reset, position unknown",
                                                         "homed",
                                                         "abandoned",
                                                         "silence",
                                                         "failed",
                                                         "stood",
                                                         "trip"};
  return kNames[static_cast<std::size_t>(event)];
}

}  // namespace mrroc::edp
