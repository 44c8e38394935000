#include "test/edp/automaton_document.hpp"

#include <fmt/core.h>

#include "edp/automaton.hpp"
#include "edp/platform/automaton.hpp"

namespace mrroc::edp::test {
namespace {

constexpr const char* kHead = R"(# States of an effector driver

Made from the tables in `edp/automaton.hpp` and, for mobile platforms, `edp/platform/automaton.hpp`, on which the drivers run. After
a change there:
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
# States of a mobile platform's driver

- **not synchronised**: the position is not known. The drives brake: their motors are short-circuited.
- **homing**: SYNCHRO. At rest the IMU is reset, its drift and the loads of the wheels are measured, then positions on the map are awaited.
- **ready**: the position is known; nothing was commanded yet, or a fault was reset. The drives brake.
- **executing**: follows the fragments that it has been handed. A pause is this state at pace 0.
- **decelerating**: its owner is silent or gone; the pace goes to 0 on the way, then the fragments are dropped.
- **holding**: the last point is stabilised until the platform rests, then the drives brake; pushed away it drives back, unless it was stopped.
- **faulted**: a malfunction; the drives brake, and only reset leads on.
- **jogging**: no platform is ever in it.

*Silence* is that no message of the owner has come for ten macrosteps: a fragment outlasts many of them, and *keep* is a message.

## What commands ask for

)";

std::string cell(const Transition& t, DriverState state, bool own) {
  if (t.refusal != FaultCode::none) return own ? "-" : fmt::format("*{}*", to_string(t.refusal));
  return t.next == state ? "stays" : fmt::format("**{}**", to_string(t.next));
}

/// @param first, last  events, numbers from and up to before which  @param own  they happen by themselves
template <class Event, class Table>
std::string rows(const Table& table, std::size_t first, std::size_t last, bool own) {
  std::string text = "| event |";
  for (const auto& row : table) text += fmt::format(" {} |", to_string(row.state));
  text += "\n| --- |";
  for (std::size_t k = 0; k < table.size(); ++k) text += " --- |";
  for (std::size_t e = first; e < last; ++e) {
    text += fmt::format("\n| {} |", to_string(static_cast<Event>(e)));
    for (const auto& row : table) text += fmt::format(" {} |", cell(row.on[e], row.state, own));
  }
  return text + "\n";
}

/// @param head  before what commands ask for  @param own  first event that happens by itself
template <class Event, class Table>
std::string part(const char* head, const Table& table, Event own, std::size_t events) {
  const auto first = static_cast<std::size_t>(own);
  return head + rows<Event>(table, 0, first, false) + kOwn + rows<Event>(table, first, events, true);
}

}  // namespace

std::string automaton_document() {
  return part(kHead, kAutomaton, kFirstOwnEvent, kEvents) +
         part(kPlatform, kPlatformAutomaton, kFirstOwnPlatformEvent, kPlatformEvents);
}

}  // namespace mrroc::edp::test
