// Decides which process may command an effector driver, and which of its commands is the next (docs/architecture.md, on
// the wire).
#pragma once
#include <cstdint>
#include <optional>

#include "base/effector.hpp"

namespace mrroc::edp {

/// Action of a driver for a message.
enum class Admission : std::uint8_t {
  nothing,  ///< keep, release: no command
  execute,  ///< the next command of the owner: validate it, execute or refuse it, then conclude()
  replay,   ///< the stored reply is the answer; nothing is executed
  reset,    ///< an operator's reset: the effector has no owner any more
  refuse,   ///< answer with the fault
};

/// Sessions, sequence numbers and the stored reply of one effector driver. It does not look into the
/// commands. Real-time safe.
template <Effector E>
class BasicProtocol {
 public:
  using Admission = edp::Admission;     ///< of a message
  using Command = typename E::Command;  ///< y_ce
  using Reply = typename E::Reply;      ///< x_ce
  /// Treatment of a command.
  struct Decision {
    Admission admission{Admission::nothing};  ///< what the driver has to do
    Fault fault{};                            ///< reason of a refusal
  };

  /// Decides about one message and does what release and reset say.
  ///  - keep: nothing; release: ends the session of its owner, anybody else's is ignored
  ///  - reset: from anybody with any number; ends the owner's session
  ///  - QUERY: replay when the number asked for is that of the stored reply, else unknown_number; advances
  ///    nothing
  ///  - a command of another session than the owner's: not_owner
  ///  - the expected number: execute; the number before: replay; any other: lost_command
  /// @param guarded the driver started so recently that every message may be a left-over of an earlier run
  Decision admit(const Command& command, bool guarded) noexcept;

  /// Says what became of a command that was to be executed. Its number is used up. A refused command does not
  /// make its sender the owner: a session begins with its first executed command.
  /// @param executed false: refused for its content
  void conclude(const Command& command, bool executed) noexcept;

  /// Keeps the reply to the last command for repetitions and QUERY.
  void store(const Reply& reply) noexcept { stored_ = reply; }
  /// @return the reply kept last
  [[nodiscard]] const Reply& stored() const noexcept { return stored_; }

  /// Ends the session of the owner, if any: he is dead.
  void drop_owner() noexcept;

  /// @return session that holds the driver
  [[nodiscard]] std::optional<std::int64_t> owner() const noexcept { return owner_; }
  /// @return next number that will be executed
  [[nodiscard]] std::int64_t expected() const noexcept { return expected_; }
  /// @return commands that came again after they had been executed or refused for their content
  [[nodiscard]] std::int64_t repeated() const noexcept { return repeated_; }
  /// @return commands refused because one before them was missing
  [[nodiscard]] std::int64_t lost() const noexcept { return lost_; }

 private:
  std::optional<std::int64_t> owner_;
  std::int64_t expected_{1};
  std::int64_t repeated_{};
  std::int64_t lost_{};
  Reply stored_{};
};

/// That of an arm's driver.
using Protocol = BasicProtocol<ArmEffector>;

}  // namespace mrroc::edp
