// Errors in three classes (MG 5, error handling): every error has a code, a class, a text and a remedy, and
// reaches the operator with them. The table itself is base/fault_table.hpp; docs/faults.md is made from it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/fixed_text.hpp"

namespace mrroc {

/// Consequence of an error for the effector and for the task.
enum class FaultClass : std::uint8_t {
  non_fatal,  ///< a wrong argument or a failed computation: refused with a reason, the effector goes on
  fatal,      ///< the effector malfunctions: it stops safely and waits for a reset
  system      ///< communication or a process failed: the task ends
};

/// Every error that the framework can raise by itself. What only one task can raise is registered by the task
/// (RegisteredFaults), with numbers that are none of these. The numbers travel in messages: add at the end of a group only
/// together with a new protocol version.
enum class FaultCode : std::uint16_t {
  none,
  // commands refused by an EDP
  lost_command,
  not_owner,
  start_guard,
  not_finite,
  out_of_limits,
  unknown_enum,
  illegal_in_state,
  unknown_number,
  not_synchronised,
  reset_required,
  not_at_rest,
  too_fast,
  excessive_acceleration,
  outside_workspace,
  force_limit,
  unknown_model,
  // kinematics
  not_a_rotation,
  unreachable_pose,
  joint_limit,
  // servo and drives
  over_current,
  over_speed,
  following_error,
  limit_switch,
  synchro_switch_missing,
  synchro_switch_stuck,
  encoder_index_missing,
  // sensors
  force_saturated,
  force_stuck,
  force_not_finite,
  sensor_silent,
  no_contact,
  contact_unstable,
  object_not_seen,
  // processes and messages; 34 to 39 are numbers that tasks had before they registered their own
  start_failed = 40,
  not_ready,
  process_died,
  process_hung,
  peer_silent,
  hardware_silent,
  supervisor_silent,
  stop_not_confirmed,
  ended_early,
  no_fingerprint,
  no_multicast,
  session_in_use,
  malformed_message,
  command_repeated_refused,
  cannot_write,
  no_renderer,
  host_too_slow,
  internal_error,
  // input
  bad_usage,
  bad_configuration,
  bad_drawing,
  bad_recording,
  bad_trajectory,
  bad_picture,
  bad_calibration,
  bad_script,
  bad_log,
  no_such_session = 68,  // 67 is such a number, too
  // the operator
  operator_stop,
  emergency_stop,
  interrupted,
  // a run that has an end of its own
  time_limit,
  script_ended,
  figures_missed,
  // a motion; here, so that no number changed
  excessive_torque,
  // platforms; here for the same reason
  bad_plan,
  path_not_found,
  bad_fragment,
  position_unknown,
  position_lost,
  solver_failed,
  estimate_lost,
  wheel_blocked,
  encoder_fault,
};

/// One row of the table of errors.
struct FaultEntry {
  FaultCode code;              ///< of the row, each code has one
  std::string_view name;       ///< the code in text, as it appears in logs, summaries and error lines
  FaultClass fault_class;      ///< what has to be done about it
  std::string_view text;       ///< what happened
  std::string_view remedy;     ///< what the operator can do
  std::string_view causes;     ///< what it mostly comes from, likeliest first, with semicolons between
  std::string_view follows{};  ///< what follows from it, where that is not what follows from its class
};

/// One error as it happened. Trivially copyable, travels in messages; made without allocation in the servo
/// step.
struct Fault {
  FaultCode code{FaultCode::none};  ///< none: there is no error
  FixedText<32>
      process{};  ///< process that found it, e.g. "edp arm1"; empty when the process itself is speaking
  std::int16_t axis{-1};  ///< axis or motor, counted from 0; -1: none
  double value{};         ///< the offending value, in the unit that text or the code implies
  double limit{};         ///< the limit it broke; value == limit == 0: there are no figures
  FixedText<160> text{};  ///< what the figures are, or any detail; may be empty

  /// @return whether there is an error at all; real-time safe
  [[nodiscard]] constexpr explicit operator bool() const { return code != FaultCode::none; }
  friend constexpr bool operator==(const Fault&, const Fault&) = default;
};

/// Largest number of an error, and one more.
inline constexpr std::size_t kFaultNumbers = 512;
/// Tasks take numbers from here on for errors of their own.
inline constexpr std::uint16_t kFirstTaskFault = 256;

/// Rows that a task, or what several tasks share, adds to the table of errors: a constant in the header vocabulary.hpp of
/// its folder, so that every program that can raise them, and ui_cli, has them before main() begins.
///
///   inline constexpr FaultCode kLostTool{kFirstTaskFault + 7};
///   inline constexpr std::array kFaults{FaultEntry{kLostTool, "lost_tool", FaultClass::non_fatal, "...", "...", "..."}};
///   inline const RegisteredFaults kRegistered{kFaults};
class RegisteredFaults {
 public:
  /// @param rows  live as long as the program. Ends the program when a number or name is taken already, or too large
  explicit RegisteredFaults(std::span<const FaultEntry> rows) noexcept;
};

/// @return all rows, the registered ones among them, by number
[[nodiscard]] std::vector<FaultEntry> all_faults();
/// @return the row of the table; of internal_error for a number that is no code. Real-time safe
[[nodiscard]] const FaultEntry& fault_entry(FaultCode code) noexcept;
/// @return the code in text, e.g. "lost_command". Real-time safe
[[nodiscard]] std::string_view to_string(FaultCode code) noexcept;
/// @return "non-fatal", "fatal" or "system". Real-time safe
[[nodiscard]] std::string_view to_string(FaultClass fault_class) noexcept;
/// @return what follows from it: for the effector, for the task
[[nodiscard]] std::string_view consequence(const FaultEntry& entry) noexcept;
/// @return what happened and what to do, as one line: with a semicolon, or as two sentences behind a question
[[nodiscard]] std::string with_remedy(const std::string& what, std::string_view remedy);
/// @return the class of the code. Real-time safe
[[nodiscard]] FaultClass class_of(FaultCode code) noexcept;
/// @return the code that a message carries as a number, or nothing when there is none with it. Real-time safe
[[nodiscard]] std::optional<FaultCode> fault_code(std::int64_t number) noexcept;
/// @return the code with this name, or nothing
[[nodiscard]] std::optional<FaultCode> fault_code(std::string_view name) noexcept;

/// @return what happened, in one line without the remedy: the table's text, axis, figures, detail and
/// process.
///         Without control characters (base/printable.hpp), so that a message cannot speak to the terminal.
[[nodiscard]] std::string what_happened(const Fault& fault);
/// @return the full sentence: class, code, what happened and the remedy
[[nodiscard]] std::string describe(const Fault& fault);
/// @param session  that hints have to name, see command_hint(); empty: none
/// @return the last line on standard error: `error: CODE: what happened; what to do`
[[nodiscard]] std::string error_line(const Fault& fault, std::string_view session = {});
/// @return exit status of a program that ends with this code: 0 none, 2 bad input, 3 system, otherwise 1
[[nodiscard]] int exit_status(FaultCode code) noexcept;

/// An error on its way up through a shell. Never thrown in the servo step.
class FaultError : public std::runtime_error {
 public:
  /// An error as it was found: what() is the text of the table with process, axis, figures and details.
  explicit FaultError(const Fault& fault);
  /// @param what what happened, when that needs more room than a Fault has; control characters become '?'
  FaultError(FaultCode code, const std::string& what);
  /// @param remedy what to do in this very case, instead of the table's advice; empty: the table's
  FaultError(FaultCode code, const std::string& what, std::string remedy);

  /// As it was thrown.
  [[nodiscard]] const Fault& fault() const noexcept { return fault_; }
  /// @return what the operator can do
  [[nodiscard]] std::string_view remedy() const noexcept;
  /// @param session  that hints have to name; empty: none
  /// @return as error_line(fault()), with the whole text of what() and with remedy()
  [[nodiscard]] std::string error_line(std::string_view session = {}) const;

 private:
  Fault fault_;
  std::string remedy_;
};

}  // namespace mrroc
