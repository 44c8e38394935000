#include "base/link/run_folder.hpp"

#include <fmt/core.h>

#include <string_view>

#include "base/fault.hpp"
#include "base/link/log_reader.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;

/// @return where run folders are, with the newest one here
std::string where_runs_are() {
  std::error_code ignored;
  fs::path newest;
  fs::file_time_type when;
  for (const auto& entry : fs::directory_iterator("runs", ignored)) {
    const fs::path log = entry.path() / kEventLog;
    if (!fs::exists(log, ignored)) continue;
    const auto written = fs::last_write_time(log, ignored);
    if (newest.empty() || written > when) newest = entry.path(), when = written;
  }
  const std::string here = newest.empty() ? "there are none here" : "the newest here is " + newest.string();
  return "name the folder that a task told in its line `run folder:`; they are in runs/ of where it was "
         "started, and " +
         here;
}

}  // namespace

fs::path checked_run_folder(const fs::path& folder) {
  std::error_code ignored;
  for (const std::string_view file : {kEventLog, std::string_view("config.toml")}) {
    if (fs::exists(folder / file, ignored)) continue;
    throw FaultError(FaultCode::bad_log,
                     fs::is_directory(folder, ignored)
                         ? fmt::format("{} is no run folder: it has no {}", folder.string(), file)
                         : fmt::format("there is no folder {}", folder.string()),
                     where_runs_are());
  }
  return folder;
}

}  // namespace mrroc::link
