// What kind of effector an agent has.
#pragma once
#include <cstdint>

namespace mrroc {

/// Numbers are those of task_status_t.
enum class EffectorKind : std::uint8_t { arm, platform };

}  // namespace mrroc
