// What kind of effector an agent has.
#pragma once
#include <cstdint>

namespace mrroc {

/// Numbers are those of task_status_t. An agent without an effector has none.
enum class EffectorKind : std::uint8_t { arm, platform, none };

}  // namespace mrroc
