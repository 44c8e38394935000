// The state automaton of a platform's effector driver, as edp/automaton.hpp is that of an arm's. The driver runs on it,
// docs/automaton.md is made from it.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "edp/state_table.hpp"

namespace mrroc::edp {

/// Events of a platform's driver. The first ones are what commands ask for, and may be refused; the last ones happen by
/// themselves. QUERY is legal in every state and changes none, so it is no event.
enum class PlatformEvent : std::uint8_t {
  fragment,       ///< SET: a fragment of a trajectory
  synchro,        ///< SYNCHRO
  reset,          ///< reset of a platform that knows its position
  reset_unknown,  ///< reset of a platform that does not
  located,        ///< SYNCHRO has found the position
  abandoned,      ///< nobody owns the driver any more: released, dead, or stopped
  silence,        ///< no message has come for too long
  arrived,        ///< the last fragment has ended
  stood,          ///< the pace has come to 0
  trip,           ///< a malfunction
};
/// Number of events.
inline constexpr std::size_t kPlatformEvents = 10;
/// Events before this one are asked for by commands, the others happen by themselves.
inline constexpr PlatformEvent kFirstOwnPlatformEvent = PlatformEvent::located;

/// One row of the table.
using PlatformStateRow = BasicStateRow<PlatformEvent, kPlatformEvents>;

/// Row k describes the state with the number k. What is not said is illegal_in_state. A platform is never jogging.
inline constexpr std::array<PlatformStateRow, kDriverStates> kPlatformAutomaton = [] {
  using enum DriverState;
  using enum PlatformEvent;
  using F = FaultCode;
  using Row = table::BasicRow<PlatformEvent, kPlatformEvents>;
  const auto any = [](DriverState s) {
    return Row(s).go(faulted, trip).stay(PlatformEvent::reset, reset_unknown, abandoned, silence);
  };
  return std::array<PlatformStateRow, kDriverStates>{
      any(not_synchronised).go(homing, synchro).refuse(F::not_synchronised, fragment),
      any(homing).go(ready, located).go(not_synchronised, abandoned),
      any(ready).go(executing, fragment),
      any(executing).stay(fragment).go(holding, arrived).go(decelerating, abandoned, silence),
      any(decelerating).refuse(F::not_at_rest, fragment).go(holding, stood),
      any(holding).go(executing, fragment),
      any(faulted)
          .go(ready, PlatformEvent::reset)
          .go(not_synchronised, reset_unknown)
          .refuse(F::reset_required, fragment, synchro),
      any(jogging),
  };
}();
static_assert(table::is_in_order(kPlatformAutomaton));

/// @return what an event leads to. Real-time safe
constexpr const Transition& transition(DriverState state, PlatformEvent event) noexcept {
  return kPlatformAutomaton[static_cast<std::size_t>(state)].on[static_cast<std::size_t>(event)];
}

/// @return name of an event, for documents
constexpr std::string_view to_string(PlatformEvent event) noexcept {
  constexpr std::array<std::string_view, kPlatformEvents> kNames{"SET fragment",
                                                                 "SYNCHRO",
                                                                 "reset, position known",
                                                                 "reset, position unknown",
                                                                 "located",
                                                                 "abandoned",
                                                                 "silence",
                                                                 "arrived",
                                                                 "stood",
                                                                 "trip"};
  return kNames[static_cast<std::size_t>(event)];
}

}  // namespace mrroc::edp
