#include "base/effector_command.hpp"

#include <type_traits>

namespace mrroc {

static_assert(std::is_trivially_copyable_v<EffectorCommand>);
static_assert(std::is_trivially_copyable_v<EffectorReply>);

std::string_view to_string(DriverState s) {
  switch (s) {
    case DriverState::not_synchronised:
      return "not synchronised";
    case DriverState::homing:
      return "homing";
    case DriverState::ready:
      return "ready";
    case DriverState::executing:
      return "executing";
    case DriverState::decelerating:
      return "decelerating";
    case DriverState::holding:
      return "holding";
    case DriverState::faulted:
      return "faulted";
    case DriverState::jogging:
      return "jogging";
  }
  return "unknown";
}

}  // namespace mrroc
