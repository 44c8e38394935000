#include "mp/black_box.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

#include "base/link/log_tail.hpp"
#include "base/msg/message_type.hpp"
#include "mrroc/effector_reply_t.hpp"
#include "mrroc/platform_reply_t.hpp"

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;

constexpr double kStep = 0.002;  // of the drivers [s]
constexpr std::string_view kFolder = "black_box";

/// @return the step of the reading, in a reply of any kind of effector driver
std::optional<std::int64_t> step_of_reply(const link::LoggedMessage& m) {
  if (!m.channel.ends_with(".reply")) return {};
  if (const auto arm = link::decode<effector_reply_t>(m.bytes)) return arm->step;
  if (const auto platform = link::decode<platform_reply_t>(m.bytes)) return platform->step;
  return {};
}

/// @return simulated time at which each message was written [s]: that of the newest reading of any driver
std::vector<double> times_of(const std::vector<link::LoggedMessage>& messages) {
  std::vector<double> times;
  times.reserve(messages.size());
  double t = 0;
  for (const link::LoggedMessage& m : messages) {
    if (const auto step = step_of_reply(m)) t = std::max(t, static_cast<double>(*step) * kStep);
    times.push_back(t);
  }
  return times;
}

/// @return what was written last before that place of the file, in kBlackBox seconds or more, however long the log is
std::vector<link::LoggedMessage> last_messages(const fs::path& file, std::uintmax_t end = UINTMAX_MAX) {
  constexpr std::uintmax_t kFirst = 4'000'000, kMost = 64'000'000;  // [bytes]
  for (std::uintmax_t bytes = kFirst;; bytes *= 2) {
    link::LogTail tail = link::read_tail(file, bytes, end);
    const std::vector<double> times = times_of(tail.messages);
    const auto first = std::ranges::find_if(times, [](double t) { return t > 0; });
    const bool enough = first != times.end() && times.back() - *first > kBlackBox;
    if (tail.whole || enough || bytes * 2 > kMost) return std::move(tail.messages);
  }
}

/// @return what a log held at that moment, or holds at its end, as far as last_messages()
std::vector<link::LoggedMessage> last_of_run(const fs::path& folder,
                                             const std::optional<link::LogEnd>& as_of) {
  if (!as_of) {
    std::vector<link::LoggedMessage> messages = last_messages(folder / link::kEventLog);
    std::ranges::move(last_messages(folder / link::kEventTail), std::back_inserter(messages));
    return messages;
  }
  std::vector<link::LoggedMessage> messages = last_messages(folder / link::kEventLog, as_of->size);
  for (const auto& m : as_of->tail)
    messages.push_back({m->time_us, m->channel.substr(m->channel.find('.') + 1), m->bytes});
  return messages;
}

/// A kind of messages is sent by one level, whatever the task is.
struct KindOfMessage {
  std::string_view kind;    // last word of the message's name
  std::string_view sender;  // a process, or the level whose process has the key of the channel behind it
  bool of_robot_or_camera;
};
constexpr std::array kLevels{
    KindOfMessage{"order", "mp", false},          KindOfMessage{"answer", "mp", false},
    KindOfMessage{"control", "mp", false},        KindOfMessage{"image", "mp", false},
    KindOfMessage{"frame", "simulator", false},   KindOfMessage{"truth", "simulator", false},
    KindOfMessage{"capture", "simulator", false}, KindOfMessage{"command", "ecp", true},
    KindOfMessage{"report", "ecp", true},         KindOfMessage{"reply", "edp", true},
    KindOfMessage{"samples", "edp", true},        KindOfMessage{"telemetry", "edp", true},
    KindOfMessage{"reading", "vsp", true},
};

/// @param message  "cube_order_t" @return "order"
std::string_view kind_of(std::string_view message) {
  message.remove_suffix(message.ends_with("_t") ? 2 : 0);
  return message.substr(message.rfind('_') + 1);
}

std::string line_of(const link::LoggedMessage& m, const MessageType* type, double t) {
  std::string line = fmt::format("{:9.3f}  {}  i={}", t, m.channel, link::header_of(m.bytes).stamp);
  if (!type) return line + "  (unknown)\n";
  for (const Field& f : type->fields) {
    if (f.name.starts_with("header.")) continue;
    const std::string value = value_in(m.bytes, f);
    if (value != "0" && value != "-0" && value != "\"\"") line += fmt::format(" {}={}", f.name, value);
  }
  return line + "\n";
}

}  // namespace

std::string sender_of(const std::string& channel, std::string_view message) {
  const std::size_t point = channel.rfind('.');
  if (point == std::string::npos)
    return channel == "supervisor" || channel == "task_status" || channel == "answer" ? "mp" : "";
  std::string name = channel.substr(0, point);
  const std::string what = channel.substr(point + 1);
  if (what == "status" || what == "console") return name;
  if (name.find('.') != std::string::npos) return "";  // a typed link or a setting: of any agent
  const std::string_view kind = message.empty() ? what : kind_of(message);
  if (kind == "report" && name == "hand") return "simulator";
  const auto level = std::ranges::find(kLevels, kind, &KindOfMessage::kind);
  if (level == kLevels.end()) return "";
  return level->of_robot_or_camera ? fmt::format("{}-{}", level->sender, name) : std::string(level->sender);
}

std::vector<std::string> black_box_files(const fs::path& folder) {
  std::vector<std::string> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.path().filename().string().find("-fault-") != std::string::npos)
      files.push_back(entry.path().filename().string());
  for (const auto& entry : fs::recursive_directory_iterator(folder / kFolder, none))
    if (entry.is_regular_file(none)) files.push_back(entry.path().lexically_relative(folder).string());
  std::ranges::sort(files);
  return files;
}

std::vector<std::string> write_black_box(const fs::path& folder, const std::vector<std::string>& roster,
                                         const std::string& within,
                                         const std::optional<link::LogEnd>& as_of) {
  const std::vector<link::LoggedMessage> messages = last_of_run(folder, as_of);
  if (messages.empty()) return black_box_files(folder);  // the steps of the drivers are what there is
  const std::vector<double> times = times_of(messages);
  const double from = times.back() - kBlackBox;
  std::map<std::string, std::string> texts;
  for (const std::string& name : roster) texts[name];
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (times[k] < from) continue;
    const MessageType* const type = type_of(messages[k].bytes);
    const auto process = texts.find(sender_of(messages[k].channel, type ? type->name : ""));
    if (process != texts.end()) process->second += line_of(messages[k], type, times[k]);
  }
  std::error_code none;
  const fs::path place = within.empty() ? folder / kFolder : folder / kFolder / within;
  fs::create_directories(place, none);
  for (const auto& [process, text] : texts)
    std::ofstream(place / (process + ".txt"))
        << "# simulated time [s], channel, macrostep, fields that are not 0\n"
        << text;
  return black_box_files(folder);
}

}  // namespace mrroc::mp
