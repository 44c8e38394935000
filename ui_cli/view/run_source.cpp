#include "ui_cli/view/run_source.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/fault.hpp"
#include "base/link/log_reader.hpp"
#include "base/link/run_folder.hpp"
#include "ui_cli/json_file.hpp"
#include "ui_cli/view/listener.hpp"

namespace mrroc::view {
namespace {

namespace fs = std::filesystem;

nlohmann::json summary_of(const fs::path& folder) {
  return ui::json_file<nlohmann::json>(folder / "summary.json");
}

std::string text_of(const nlohmann::json& j) {
  return j.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

/// @return the number of that key, 0 where there is none
double number(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

/// @return the text of that key, empty where there is none
std::string words(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

void add_pictures(const fs::path& folder, const std::string& prefix, std::vector<std::string>& found) {
  const auto before = static_cast<std::ptrdiff_t>(found.size());
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / prefix, none))
    if (entry.path().extension() == ".png" && entry.is_regular_file(none))
      found.push_back(prefix + entry.path().filename().string());
  std::sort(found.begin() + before, found.end());
}

}  // namespace

std::vector<std::string> pictures_of(const fs::path& folder) {
  constexpr std::size_t kMost = 64;
  std::vector<std::string> found;
  add_pictures(folder, "", found);
  add_pictures(folder, "plots/", found);
  if (found.size() > kMost) found.resize(kMost);
  return found;
}

Scene scene_of(const fs::path& folder) {
  if (!fs::is_regular_file(folder / "config.toml"))
    throw FaultError(FaultCode::bad_usage,
                     fmt::format("{} is no run folder: it has no config.toml", folder.string()),
                     "name a folder that a task has left, such as runs/press-2026-01-01T10-00-00");
  return read_scene(Config::load(folder / "config.toml"));
}

void load_summary(const fs::path& folder, Record& record) {
  const nlohmann::json summary = summary_of(folder);
  if (!summary.is_object()) return;
  record.set("summary", text_of(summary));
  const nlohmann::json fault = summary.value("fault", nlohmann::json());
  if (!fault.is_object()) return;
  record.log(text_of({{"t", number(summary, "sim_s")},
                      {"process", words(fault, "process")},
                      {"code", words(fault, "code")},
                      {"text", "the run ended: " + words(fault, "text")},
                      {"fault", 1}}));
}

std::vector<std::string> load_run(const fs::path& folder, Record& record) {
  const Scene scene = scene_of(link::checked_run_folder(folder));
  const nlohmann::json summary = summary_of(folder);
  SceneFrame frame{.source = "run", .folder = folder.string(), .pictures = pictures_of(folder)};
  if (summary.is_object()) frame.task = words(summary, "task");
  record.begin(scene_json(scene, frame));
  Listener listener(record, scene, "", 0);
  const link::LogReader log(folder);
  for (const link::LoggedMessage& m : log.messages())
    listener.receive(log.session() + "." + m.channel, m.bytes);
  load_summary(folder, record);
  listener.publish_count();
  return frame.pictures;
}

}  // namespace mrroc::view
