// The consequence of a command that the effector refuses or cannot execute: each row of a task's table
// chooses it (MG 5, error handling: "the handler can be redefined by the user").
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>

#include "base/effector_command.hpp"

namespace mrroc {

/// Result of the commands that an effector has answered.
enum class Mishap : std::uint8_t {
  none,     ///< nothing is wrong
  refused,  ///< a command was refused: nothing of it was executed
  failed,   ///< a command could not be executed to its end: the effector comes to rest
  tripped,  ///< a malfunction: the drives brake, and only a reset leads on
};

/// A reply x_ce of any kind of effector (base/effector.hpp).
template <class R>
concept AnyReply = requires(const R& told) {
  { told.fault } -> std::convertible_to<Fault>;
  { told.state } -> std::convertible_to<DriverState>;
  { told.verdict } -> std::convertible_to<Verdict>;
};

/// @param told  x_ce  @return what has gone wrong. A command that was lost on its way is none: the link repeats it. An agent
///              without an effector of its own has no mishap
template <class Told>
[[nodiscard]] constexpr Mishap mishap_of(const Told& told) noexcept {
  if constexpr (AnyReply<Told>) {
    if (!told.fault || told.fault.code == FaultCode::lost_command) return Mishap::none;
    if (told.state == DriverState::faulted) return Mishap::tripped;
    if (told.verdict == Verdict::refused) return Mishap::refused;
    if (told.verdict == Verdict::failed) return Mishap::failed;
  }
  return Mishap::none;
}

/// Reaction to a mishap.
enum class Response : std::uint8_t {
  end,             ///< the task ends with the fault: the agent's report tells the coordinator
  go_on,           ///< the behaviour goes on: its functions see the mishap in x_ce, and decide
  repeat,          ///< the effector is let come to rest, then the behaviour begins anew
  next_behaviour,  ///< the effector is let come to rest, then the behaviour has ended
};

/// @return whether the behaviour is left, for the next one or for itself anew
[[nodiscard]] constexpr bool leaves_behaviour(Response response) noexcept {
  return response == Response::repeat || response == Response::next_behaviour;
}

/// The responses of one row. What says nothing ends the task.
struct FaultPolicy {
  Response on_refused{Response::end};  ///< to Mishap::refused
  Response on_failed{Response::end};   ///< to Mishap::failed
  Response on_tripped{
      Response::end};  ///< to Mishap::tripped; nobody but a person or the task's own rows reset the effector

  /// @return the response to a mishap; go_on to none
  [[nodiscard]] constexpr Response to(Mishap mishap) const noexcept {
    switch (mishap) {
      case Mishap::refused:
        return on_refused;
      case Mishap::failed:
        return on_failed;
      case Mishap::tripped:
        return on_tripped;
      case Mishap::none:
        break;
    }
    return Response::go_on;
  }
  friend constexpr bool operator==(const FaultPolicy&, const FaultPolicy&) = default;
};
/// @return a policy with one response to whatever goes wrong with a command; malfunctions end the task
[[nodiscard]] constexpr FaultPolicy respond(Response response) noexcept { return {response, response}; }

/// @param told  x_ce  @return whether the effector moves, or is on its way to rest
template <AnyReply Reply>
[[nodiscard]] bool moves(const Reply& told) noexcept {
  constexpr std::array kMoving{DriverState::homing, DriverState::executing, DriverState::decelerating,
                               DriverState::jogging};
  return std::ranges::find(kMoving, told.state) != kMoving.end();
}

}  // namespace mrroc
