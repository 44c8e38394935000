// Which command is legal in which state of an effector driver: one table.
#pragma once
#include <array>
#include <cstddef>

#include "base/effector_command.hpp"

namespace mrroc::edp {

/// Parts of commands that a state may forbid. QUERY and reset are legal in every state.
enum class Request : std::uint8_t {
  get,         ///< GET, also as part of SET_GET
  arm,         ///< SET ARM
  tool,        ///< SET ROBOT_MODEL TOOL
  force_tool,  ///< SET ROBOT_MODEL FORCE_TOOL, force_bias: both need a standstill
  synchro,     ///< SYNCHRO
};
inline constexpr std::size_t kRequests = 5;

/// What a state says to each request: none when it is legal, else the fault.
struct StateRow {
  DriverState state;
  std::array<FaultCode, kRequests> answer;
};

// clang-format off
/// Row k describes the state with the number k.
inline constexpr std::array<StateRow, 7> kStateTable = [] {
  using enum FaultCode;
  return std::array<StateRow, 7>{{
  //  state                          get               arm               tool              force_tool        synchro
    {DriverState::not_synchronised, {none,             not_synchronised, not_synchronised, not_synchronised, none}},
    {DriverState::homing,           {none,             illegal_in_state, illegal_in_state, illegal_in_state, illegal_in_state}},
    {DriverState::ready,            {none,             none,             none,             none,             illegal_in_state}},
    {DriverState::executing,        {none,             none,             none,             not_at_rest,      illegal_in_state}},
    {DriverState::decelerating,     {none,             none,             none,             not_at_rest,      illegal_in_state}},
    {DriverState::holding,          {none,             none,             none,             none,             illegal_in_state}},
    {DriverState::faulted,          {reset_required,   reset_required,   reset_required,   reset_required,   reset_required}},
  }};
}();
// clang-format on

static_assert([] {
  for (std::size_t k = 0; k < kStateTable.size(); ++k)
    if (static_cast<std::size_t>(kStateTable[k].state) != k) return false;
  return true;
}());

/// @return none when the request is legal in the state, else the code of the refusal. Real-time safe
constexpr FaultCode verdict_on(DriverState state, Request request) noexcept {
  return kStateTable[static_cast<std::size_t>(state)].answer[static_cast<std::size_t>(request)];
}

}  // namespace mrroc::edp
