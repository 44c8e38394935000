#include "test/edp/automaton_document.hpp"

#include <fmt/core.h>

#include "edp/automaton.hpp"

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

std::string cell(const StateRow& row, Event event) {
  const Transition& t = transition(row.state, event);
  if (t.refusal != FaultCode::none)
    return event >= kFirstOwnEvent ? "-" : fmt::format("*{}*", to_string(t.refusal));
  return t.next == row.state ? "stays" : fmt::format("**{}**", to_string(t.next));
}

std::string rows(std::size_t first, std::size_t last) {
  std::string text = "| event |";
  for (const StateRow& row : kAutomaton) text += fmt::format(" {} |", to_string(row.state));
  text += "\n| --- |";
  for (std::size_t k = 0; k < kAutomaton.size(); ++k) text += " --- |";
  for (std::size_t e = first; e < last; ++e) {
    text += fmt::format("\n| {} |", to_string(static_cast<Event>(e)));
    for (const StateRow& row : kAutomaton) text += fmt::format(" {} |", cell(row, static_cast<Event>(e)));
  }
  return text + "\n";
}

}  // namespace

std::string automaton_document() {
  const auto own = static_cast<std::size_t>(kFirstOwnEvent);
  return kHead + rows(0, own) + kOwn + rows(own, kEvents);
}

}  // namespace mrroc::edp::test
