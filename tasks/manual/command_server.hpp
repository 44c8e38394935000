// Receives instructions from terminals and from a script.
#pragma once
#include <deque>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "base/instructions.hpp"
#include "base/link/process.hpp"
#include "base/transmission.hpp"
#include "mrroc/manual_answer_t.hpp"
#include "mrroc/manual_words_t.hpp"
#include "tasks/manual/instruction_script.hpp"
#include "tasks/manual/vocabulary.hpp"

namespace mrroc::manual {

/// The operator's instructions of a macrostep: part of the coordinator's x_cT_0h.
struct Hands {
  std::vector<std::optional<ManualOrder>> orders;  ///< new ones, one place per arm; numbers not yet given
  bool end{};                                      ///< the task is to end
};

/// Takes instructions at a macrostep (rule R3), refuses what the arms cannot do now, and tells terminals what has
/// become of theirs. Everything that was taken is written to a script that replays the run.
class CommandServer {
 public:
  /// Channels of words and answers, without the session.
  static constexpr const char* kWords = "manual.words";
  static constexpr const char* kAnswer = "manual.answer";

  /// @param record  where what is taken is written; empty: nowhere
  CommandServer(link::Process& process, std::vector<ArmInfo> arms, InstructionScript script,
                const std::filesystem::path& record);

  /// Instructions for macrostep i.
  /// @param given    numbers of the last orders that the arms have got
  /// @param reports  what the arms say now
  /// @param paused   the arms stand for a pause: terminals are refused what would begin at its end, when nobody waits
  ///                 for it any more; a stop is done at once. A script goes on
  Hands take(std::int64_t i, const std::vector<std::int64_t>& given, const std::vector<Report>& reports,
             bool paused);

  /// @return whether everything in the script has been taken, and no terminal has given an instruction
  [[nodiscard]] bool over() const { return script_.empty() && asked_.empty(); }

 private:
  struct Asked {
    std::int64_t id{};                                         ///< of the terminal's message
    std::vector<std::pair<std::size_t, std::int64_t>> orders;  ///< arm and number
    bool stop{};                                               ///< an arm that stands for a fault has obeyed
    manual_answer_t answer{};
  };
  struct Refusal {
    std::string reason;
    InstructionState state{InstructionState::refused};
  };
  /// @param paused  only what asks no arm to move is taken
  /// @return why the instruction is refused, or nothing: it is in hands
  std::optional<Refusal> obey(std::int64_t i, const std::string& words,
                              const std::vector<std::int64_t>& given, const std::vector<Report>& reports,
                              bool paused, Hands& hands, Asked& asked);
  /// A stop takes the place, and the number, of the order in the same macrostep.
  void call_off(std::size_t arm, std::int64_t number);
  void answer_terminals(std::int64_t i, const std::vector<std::int64_t>& given,
                        const std::vector<Report>& reports, bool paused, Hands& hands);
  void conclude(Asked& asked, const std::vector<Report>& reports);

  link::Process& process_;
  std::vector<ArmInfo> arms_;
  link::Queue<manual_words_t> words_in_;
  link::Outbox<manual_answer_t> answer_out_;
  std::deque<ScriptedInstruction> script_;
  std::ofstream record_;
  std::deque<Asked> asked_;  // the last ones, answered again when they are repeated
};

}  // namespace mrroc::manual
