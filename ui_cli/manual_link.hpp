// A terminal's link to the task `manual`: sends instructions, receives their results and the arms' readings.
#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/effector_command.hpp"
#include "base/instructions.hpp"
#include "base/link/bus.hpp"
#include "base/link/session.hpp"
#include "mrroc/manual_answer_t.hpp"
#include "mrroc/manual_words_t.hpp"
#include "ui_cli/client.hpp"

namespace mrroc::ui {

/// Characters of an instruction at most: what its message has room for.
inline constexpr std::size_t kLongestInstruction = sizeof(manual_words_t{}.text) - 1;
/// Words that a shell accepts besides the instructions of the task.
inline constexpr std::array<std::string_view, 4> kOfShell{"show", "save", "teach", "load"};
/// @return that an instruction has too many characters
[[nodiscard]] std::string too_long(std::size_t characters);
/// The remedy, for the error line.
inline constexpr const char* kShorter = "write numbers with fewer digits";

/// The task's word on an instruction.
struct ManualAnswer {
  std::string words;         ///< of the instruction
  InstructionState state{};  ///< what has become of it
  std::string text;          ///< reason, or what has been done; without control characters
};

/// Sends one instruction at a time, again and again until it is done: every sending is answered, so that an answer
/// that was lost comes again. Used by one thread.
class ManualLink {
 public:
  /// @param bus  must outlive the link, which must outlive the last bus.wait()  @param session  of the task
  /// @param arms  whose readings are wanted
  ManualLink(link::Bus& bus, const link::SessionInfo& session, const std::vector<std::string>& arms,
             Timeouts timeouts = {});
  ~ManualLink();
  ManualLink(const ManualLink&) = delete;
  ManualLink& operator=(const ManualLink&) = delete;

  /// Begins with an instruction; nothing more is heard of the one before.
  /// @throws FaultError bad_usage: it is longer than kLongestInstruction
  void begin(const std::string& words, Clock::time_point now);
  /// @return whether an instruction waits for its first answer
  [[nodiscard]] bool unanswered() const { return id_ != 0 && !told_; }
  /// Sends what has to be sent. Call it often.
  /// @return news of the instruction: that it was taken, and what became of it, each once
  /// @throws FaultError peer_silent, once, when nothing has been heard for Timeouts::give_up
  std::optional<ManualAnswer> poll(Clock::time_point now);

  /// @return the newest reading of an arm, or nothing before the first
  [[nodiscard]] std::optional<EffectorReply> reading(const std::string& arm) const;

 private:
  struct Answers;
  struct Readings;

  link::Bus& bus_;
  link::SessionInfo session_;
  Timeouts timeouts_;
  std::unique_ptr<Answers> answers_;
  std::map<std::string, std::unique_ptr<Readings>> readings_;
  std::string words_;
  std::int64_t id_{};  // 0: no instruction
  std::int64_t count_{};
  std::optional<InstructionState> told_;
  Clock::time_point heard_{}, sent_{};
};

}  // namespace mrroc::ui
