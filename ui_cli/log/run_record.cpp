#include "ui_cli/log/run_record.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "base/closest_match.hpp"
#include "base/config.hpp"
#include "base/fault.hpp"
#include "base/link/channel.hpp"
#include "base/link/run_folder.hpp"

namespace mrroc::ui {
namespace {

namespace fs = std::filesystem;

/// A run of somebody else must not choose what is started: only what stands beside this program.
/// @return the name @throws FaultError bad_log: it leads elsewhere
std::string plain_name(const fs::path& file, const std::string& name) {
  if (!name.empty() && name != "." && name != ".." && fs::path(name).filename() == name) return name;
  throw FaultError(FaultCode::bad_log,
                   fmt::format("{}: '{}' is not the plain name of a program", file.string(), name));
}

}  // namespace

RunRecord::RunRecord(const fs::path& folder) : folder_(link::checked_run_folder(folder)), log_(folder_) {
  const Config config = Config::load((folder_ / "config.toml").string());
  step_s_ = config.number("time.dt", 0.002, {1e-4, 1}, "s");
  macrostep_s_ = step_s_ * config.integer("time.n_s", 10, {1, 1000}, "steps");
  platforms_ = config.texts("platforms.order", std::vector<std::string>{});
  arms_ = config.texts("robots.order", std::vector<std::string>{});
  const fs::path file = folder_ / "processes.json";
  std::ifstream in(file);
  if (!in) return;
  try {
    const auto json = nlohmann::json::parse(in);
    clock_ = json.at("clock").get<std::string>();
    task_ = plain_name(file, json.at("task").get<std::string>());
    for (const auto& p : json.at("processes"))
      processes_.push_back({p.at("name").get<std::string>(),
                            plain_name(file, p.at("program").get<std::string>()),
                            p.at("arguments").get<std::vector<std::string>>(), p.value("build_id", "")});
  } catch (const nlohmann::json::exception& e) {
    throw FaultError(FaultCode::bad_log, fmt::format("{}: {}", file.string(), e.what()));
  }
}

Effector RunRecord::effector_of(const std::string& agent) const {
  if (std::ranges::find(platforms_, agent) != platforms_.end()) return Effector::platform;
  const bool is_arm = platforms_.empty() || std::ranges::find(arms_, agent) != arms_.end();
  return is_arm ? Effector::arm : Effector::none;
}

std::vector<std::string> RunRecord::agents() const {
  constexpr std::string_view kReport = ".report";
  std::set<std::string> keys;
  for (const link::LoggedMessage& m : log_.messages()) {
    if (!m.channel.ends_with(kReport)) continue;
    const MessageType* const type = type_of(m.bytes);
    if (type && type->name == "agent_report_t")
      keys.insert(m.channel.substr(0, m.channel.size() - kReport.size()));
  }
  return {keys.begin(), keys.end()};
}

std::optional<double> RunRecord::time_of(const link::LoggedMessage& m) const {
  const MessageType* const type = type_of(m.bytes);
  if (!type || type->time_unit == TimeUnit::none || link::header_of(m.bytes).stamp == link::kEndOfLink)
    return std::nullopt;
  return number_in(m.bytes, *type->field(type->time)) *
         (type->time_unit == TimeUnit::steps ? step_s_ : macrostep_s_);
}

void check_channel(const RunRecord& run, const std::string& channel) {
  const auto channels = run.log().channels();
  if (std::ranges::find(channels, channel) != channels.end()) return;
  throw FaultError(FaultCode::bad_usage,
                   fmt::format("the log has no channel '{}'{}", channel,
                               did_you_mean(channel, WordSet(channels.begin(), channels.end()))),
                   "`ui_cli log csv RUN` lists them");
}

bool by_wall_clock(std::string_view channel) {
  constexpr std::array<std::string_view, 6> kWhole{"supervisor", "task_status",  "answer",
                                                   "operator",   "manual.words", "manual.answer"};
  return channel.ends_with(".status") || channel.ends_with(".console") ||
         std::ranges::find(kWhole, channel) != kWhole.end();
}

std::string message_text(const link::LoggedMessage& m) {
  const MessageType* const type = type_of(m.bytes);
  if (!type) return fmt::format("{} bytes that are no message of this version", m.bytes.size());
  std::string text;
  for (const Field& f : type->fields) {
    const auto bytes = std::span(m.bytes).subspan(f.offset, f.size);
    if (f.name.starts_with("header.") || std::ranges::all_of(bytes, [](std::uint8_t b) { return b == 0; }))
      continue;
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", f.name, value_in(m.bytes, f));
  }
  return text;
}

}  // namespace mrroc::ui
