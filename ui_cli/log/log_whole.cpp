#include "ui_cli/log/log_whole.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <span>
#include <utility>

#include "base/counted.hpp"
#include "base/hash.hpp"
#include "base/link/event_log.hpp"
#include "base/link/process.hpp"
#include "base/link/text.hpp"
#include "mrroc/process_status_t.hpp"

namespace mrroc::ui {
namespace {

constexpr std::size_t kAfterSession = 16;  // of a message: LCM's fingerprint and the session

/// Messages of one channel as they were sent: each number once, from 1.
struct Sent {
  std::map<std::int64_t, std::span<const std::uint8_t>> messages;

  /// Leaves out what was sent after the fingerprint of that many messages was taken (Process::seal_fingerprints).
  void keep_first(std::int64_t count) { messages.erase(messages.upper_bound(count), messages.end()); }

  [[nodiscard]] std::int64_t hash() const {
    Hash hash;
    for (const auto& [number, bytes] : messages)
      hash.add(bytes.subspan(std::min(bytes.size(), kAfterSession)));
    return static_cast<std::int64_t>(hash.value());
  }
};

}  // namespace

std::string damage_of(const RunRecord& run) {
  std::map<std::string, Sent> sent;
  for (const link::LoggedMessage& m : run.log().messages())
    sent[m.channel].messages.emplace(link::header_of(m.bytes).number, m.bytes);

  bool ended = false;
  for (const LoggedProcess& process : run.processes()) {
    const auto told = run.log().messages<process_status_t>(process.name + ".status");
    for (const auto& [stamp, status] : told) {
      if (status.state != static_cast<int>(link::ProcessState::done)) continue;
      ended = true;
      for (int k = 0; k < std::min<int>(status.n_hashes, static_cast<int>(std::size(status.hash))); ++k) {
        std::string channel = link::get_text(status.hash[k].channel);
        channel.erase(0, 1);  // the dot behind the session's name, which is left out
        const auto found = sent.find(channel);
        if (found == sent.end()) continue;
        found->second.keep_first(status.hash[k].count);
        const auto count = static_cast<std::int64_t>(found->second.messages.size());
        if (count != status.hash[k].count)
          return fmt::format("{} has {}, {} sent {}", channel, counted(count, "message"), process.name,
                             status.hash[k].count);
        if (found->second.hash() != status.hash[k].hash)
          return fmt::format("{} has not the bytes that {} sent", channel, process.name);
      }
    }
  }
  if (ended) return "";
  std::error_code none;
  if (std::filesystem::exists(run.folder() / link::kEventTail, none))
    return fmt::format("it ends where log.limit_mb let it; what came last is in {}", link::kEventTail);
  return "no process has told in it that it ended: the log is cut off, or the run was";
}

void warn_of_damage(const RunRecord& run, std::ostream& err) {
  if (run.processes().empty()) return;  // nobody could have told what was sent
  if (const std::string damage = damage_of(run); !damage.empty())
    err << fmt::format("warning: the log is not whole: {}\n", damage);
}

}  // namespace mrroc::ui
