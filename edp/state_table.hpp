// Tables of states and events, on which effector drivers run.
#pragma once
#include <array>
#include <cstddef>

#include "base/effector_command.hpp"

namespace mrroc::edp {

/// Result of an event in a state.
struct Transition {
  DriverState next{};   ///< the state afterwards; the same one when it was refused
  FaultCode refusal{};  ///< none: the event takes place. Own events that cannot happen are illegal_in_state
};

/// One row of a table: a state and what every event leads to, in the order of Event.
template <class Event, std::size_t events>
struct BasicStateRow {
  DriverState state;                  ///< before the event
  std::array<Transition, events> on;  ///< by the number of the event
};

namespace table {

/// @return the transition into a state
constexpr Transition to(DriverState next) { return {next, FaultCode::none}; }
/// Row of a state as a list of entries: nothing is said about a state itself but that it stays.
template <class Event, std::size_t events>
class BasicRow {
 public:
  /// At first every event is illegal in the state.
  constexpr explicit BasicRow(DriverState state) : row_{state, {}} {
    for (Transition& t : row_.on) t = {state, FaultCode::illegal_in_state};
  }
  /// The events lead to a state.
  template <class... Events>
  constexpr BasicRow go(DriverState next, Events... which) const {
    BasicRow r = *this;
    ((r.row_.on[static_cast<std::size_t>(which)] = to(next)), ...);
    return r;
  }
  /// The events take place and leave the state as it is.
  template <class... Events>
  constexpr BasicRow stay(Events... which) const {
    return go(row_.state, which...);
  }
  /// The events are refused for this reason.
  template <class... Events>
  constexpr BasicRow refuse(FaultCode why, Events... which) const {
    BasicRow r = *this;
    ((r.row_.on[static_cast<std::size_t>(which)] = {row_.state, why}), ...);
    return r;
  }
  constexpr operator BasicStateRow<Event, events>() const {  // NOLINT(google-explicit-constructor)
    return row_;
  }

 private:
  BasicStateRow<Event, events> row_;
};

/// @return whether row k describes the state with the number k
template <class Rows>
constexpr bool is_in_order(const Rows& rows) {
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (static_cast<std::size_t>(rows[k].state) != k) return false;
  return true;
}

}  // namespace table

}  // namespace mrroc::edp
