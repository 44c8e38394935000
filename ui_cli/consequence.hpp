// What follows from an error: for the effector, and for the task.
#pragma once
#include <string_view>

#include "base/fault.hpp"

namespace mrroc::ui {

/// @return what the framework does about it, as half a sentence; where nothing special is known of the error, what it does
///         about all errors of its class
[[nodiscard]] std::string_view consequence(FaultCode code);

}  // namespace mrroc::ui
