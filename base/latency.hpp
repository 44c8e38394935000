// Delays of the loop from the coordinator to the motion and back, in macrosteps: MG (11)-(15). docs/timing.md has the table.
//
// A message stamped i is what its reader uses in macrostep i, and what an agent decides in macrostep i is stamped i + 1:
//     MP decides an order in i; the ECP reads it in i + 1 and commands; the EDP executes in i + 2;
//     the ECP reads the reply in i + 3 and reports; MP reads the report in i + 4.
#pragma once
#include <cstdint>

namespace mrroc::latency {

/// From what one agent decides to what the reader of it decides.
inline constexpr std::int64_t kMessage = 1;

/// MG (11): from the coordinator's order to the control subsystem's command that is made of it.
inline constexpr std::int64_t kOrderToCommand = kMessage;
/// From a command to the macrostep that executes it.
inline constexpr std::int64_t kCommandToMotion = kMessage;
/// MG (12): from the coordinator's order to the motion.
inline constexpr std::int64_t kOrderToMotion = kOrderToCommand + kCommandToMotion;
/// MG (13), the driver alone: from a motion to the control subsystem's reading of the reply, which step n_Q sends.
inline constexpr std::int64_t kMotionToReply = kMessage;
/// From a reply to the coordinator's reading of the report about it.
inline constexpr std::int64_t kReplyToReport = kMessage;
/// MG (14): from a motion, which is a state of the effector, to what the coordinator decides on it.
inline constexpr std::int64_t kMotionToReport = kMotionToReply + kReplyToReport;
/// MG (15), the whole loop: from an order to what the coordinator decides on its effect.
inline constexpr std::int64_t kLoop = kOrderToMotion + kMotionToReport;

/// From a command to the reading of its answer, by the control subsystem that has made it.
inline constexpr std::int64_t kCommandToReply = kCommandToMotion + kMotionToReply;

static_assert(kOrderToCommand == 1 && kOrderToMotion == 2 && kMotionToReport == 2 && kLoop == 4,
              "the table in docs/timing.md");
static_assert(kLoop == kOrderToCommand + kCommandToReply + kReplyToReport,
              "the way of an order and of the report about it is the way of a command and of its answer, and "
              "one message more "
              "on either side");

}  // namespace mrroc::latency
