// The task's configuration.
#pragma once
#include <optional>
#include <string_view>

#include "base/config.hpp"
#include "tasks/ball/ball.hpp"
#include "tasks/ball/hand_push.hpp"

namespace mrroc::ball {

/// Reads [task] and [free_body]. Where the arms stand is left open.
/// @throws ConfigError; FaultError bad_configuration: there is no object, or the force cannot hold it by friction
[[nodiscard]] Parameters read_parameters(const Config& config);

/// Reads [hand]: arm, force, begin, duration.
/// @return nothing: nobody pushes @throws ConfigError
[[nodiscard]] std::optional<HandPush> read_hand_push(const Config& config);

/// @return the task's TOML file
[[nodiscard]] std::string_view config();

}  // namespace mrroc::ball
