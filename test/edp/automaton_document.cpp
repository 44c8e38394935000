#include "test/edp/automaton_document.hpp"

#include <fmt/core.h>

#include <span>

#include "edp/automaton.hpp"
#include "edp/platform/automaton.hpp"

namespace mrroc::edp::test {
namespace {

constexpr const char* kHead = R"(# States of an effector driver

Made from the table in `edp/automaton.hpp`, on which the driver runs. After a change there:
`MRROC_UPDATE_DOCS=1 ./run test -R AutomatonDocument`

A cell names the state that the event leads to; `stays` means that it takes place and the state does not change;
a code in italics is the reason of a refusal. `-` stands for what cannot happen by itself in that state. QUERY is
answered in every state.

## The states

- **not synchronised**: motor positions count from where the driver started. Only relative motor motions are possible, and SYNCHRO.
  The brakes are closed.
- **homing**: axis after axis looks for its switch and its zero mark, and with `homing_returns` goes back to where it stood.
- **ready**: synchronised, at rest, the regulators hold the set point; no motion was commanded yet, or a fault was reset.
- **executing**: a macrostep of a SET ARM.
- **decelerating**: no command came in time, or a macrostep failed; the set point comes to rest.
- **holding**: at rest after a motion. The brakes close after a few steps, and open with the next command.
- **faulted**: a malfunction; the drives brake, and only reset leads on.
- **jogging**: a relative motor motion before synchronisation.

A macrostep without a motion of its own (GET, SET of something else, a refused command) is *silence* to the arm. A reset frees the driver
from its owner; during homing that is *abandoned*.

## What commands ask for

)";

constexpr const char* kOwn = R"(
## What happens by itself

)";

constexpr const char* kPlatform = R"(
## Of a platform's driver

The same for the driver of a mobile platform, made from `edp/platform/automaton.hpp`. Its drives brake - their motors are short-circuited - in not synchronised,
homing, ready and faulted; in holding they do when the platform has come to rest.

- **not synchronised**: it is not known where the platform is on the map.
- **homing**: it stands, while gyro and wheel loads are measured and positions on the map are awaited (SYNCHRO).
- **ready**: it knows its position; no fragment was handed over yet, or a fault was reset.
- **executing**: it follows the fragments that it was handed.
- **decelerating**: nobody owns the driver or its owner is silent; the pace of the way goes to 0, and what is left of it is dropped.
- **holding**: the way has ended, and the last point is held; or the platform has been stopped.
- **faulted**: a malfunction; only reset leads on.

A platform never jogs.

### What commands ask of a platform

)";

constexpr const char* kOwnOfPlatform = R"(
### What happens to a platform by itself

)";

template <class Row, class E>
std::string cell(const Row& row, E event, E first_own) {
  const Transition& t = transition(row.state, event);
  if (t.refusal != FaultCode::none)
    return event >= first_own ? "-" : fmt::format("*{}*", to_string(t.refusal));
  return t.next == row.state ? "stays" : fmt::format("**{}**", to_string(t.next));
}

/// @param states  columns
template <class E, class Table>
std::string rows(const Table& states, std::size_t first, std::size_t last, E first_own) {
  std::string text = "| event |";
  for (const auto& row : states) text += fmt::format(" {} |", to_string(row.state));
  text += "\n| --- |";
  for (std::size_t k = 0; k < states.size(); ++k) text += " --- |";
  for (std::size_t e = first; e < last; ++e) {
    text += fmt::format("\n| {} |", to_string(static_cast<E>(e)));
    for (const auto& row : states) text += fmt::format(" {} |", cell(row, static_cast<E>(e), first_own));
  }
  return text + "\n";
}

std::string platform_document() {
  const auto own = static_cast<std::size_t>(kFirstOwnPlatformEvent);
  const std::span states(kPlatformAutomaton.begin(),
                         kDriverStates - 1);  // the last one, jogging, is not used
  return kPlatform + rows<PlatformEvent>(states, 0, own, kFirstOwnPlatformEvent) + kOwnOfPlatform +
         rows<PlatformEvent>(states, own, kPlatformEvents, kFirstOwnPlatformEvent);
}

}  // namespace

std::string automaton_document() {
  const auto own = static_cast<std::size_t>(kFirstOwnEvent);
  return kHead + rows<Event>(kAutomaton, 0, own, kFirstOwnEvent) + kOwn +
         rows<Event>(kAutomaton, own, kEvents, kFirstOwnEvent) + platform_document();
}

}  // namespace mrroc::edp::test
