#include "mp/black_box.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "base/fault.hpp"
#include "base/link/log_reader.hpp"
#include "base/msg/message_type.hpp"
#include "mrroc/effector_reply_t.hpp"

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;

constexpr double kStep = 0.002;  // of the drivers [s]
constexpr std::string_view kFolder = "black_box";

/// @return simulated time at which each message was written [s]: that of the newest reading of any driver
std::vector<double> times_of(const std::vector<link::LoggedMessage>& messages) {
  std::vector<double> times;
  times.reserve(messages.size());
  double t = 0;
  for (const link::LoggedMessage& m : messages) {
    if (m.channel.ends_with(".reply"))
      if (const auto reply = link::decode<effector_reply_t>(m.bytes))
        t = std::max(t, static_cast<double>(reply->step) * kStep);
    times.push_back(t);
  }
  return times;
}

std::string line_of(const link::LoggedMessage& m, double t) {
  std::string line = fmt::format("{:9.3f}  {}  i={}", t, m.channel, link::header_of(m.bytes).stamp);
  const MessageType* const type = type_of(m.bytes);
  if (!type) return line + "  (unknown)\n";
  for (const Field& f : type->fields) {
    if (f.name.starts_with("header.")) continue;
    const std::string value = value_in(m.bytes, f);
    if (value != "0" && value != "-0" && value != "\"\"") line += fmt::format(" {}={}", f.name, value);
  }
  return line + "\n";
}

}  // namespace

std::string sender_of(const std::string& channel) {
  const std::size_t point = channel.rfind('.');
  if (point == std::string::npos)
    return channel == "supervisor" || channel == "task_status" || channel == "answer" ? "mp" : "";
  std::string name = channel.substr(0, point);
  const std::string what = channel.substr(point + 1);
  if (what == "status" || what == "console") return name;
  if (what == "command" || (what == "report" && name != "hand")) return "ecp-" + name;
  if (what == "reply" || what == "samples") return "edp-" + name;
  if (what == "frame" || what == "truth" || channel == "hand.report") return "world";
  if (what == "order" || what == "image" || what == "manual" || channel == "manual.answer") return "mp";
  return channel == "manual.words" ? "" : "vsp-" + name;
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
                                         const std::string& within) {
  try {
    const link::LogReader log(folder / link::kEventLog);
    const std::vector<double> times = times_of(log.messages());
    const double from = (times.empty() ? 0 : times.back()) - kBlackBox;
    std::map<std::string, std::string> texts;
    for (const std::string& name : roster) texts[name];
    for (std::size_t k = 0; k < times.size(); ++k) {
      const auto process = texts.find(sender_of(log.messages()[k].channel));
      if (times[k] >= from && process != texts.end()) process->second += line_of(log.messages()[k], times[k]);
    }
    std::error_code none;
    const fs::path place = within.empty() ? folder / kFolder : folder / kFolder / within;
    fs::create_directories(place, none);
    for (const auto& [process, text] : texts)
      std::ofstream(place / (process + ".txt"))
          << "# simulated time [s], channel, macrostep, fields that are not 0\n"
          << text;
  } catch (const FaultError&) {  // no log: the steps of the drivers are what there is
  }
  return black_box_files(folder);
}

}  // namespace mrroc::mp
