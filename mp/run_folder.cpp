#include "mp/run_folder.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;

fs::path fresh_name(const std::string& task) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  std::array<char, 32> time{};
  std::strftime(time.data(), time.size(), "%Y%m%d-%H%M%S", &local);
  const std::string stem = fmt::format("{}-{}", task, time.data());
  fs::path folder = fs::path("runs") / stem;
  for (int k = 2; fs::exists(folder); ++k) folder = fs::path("runs") / fmt::format("{}-{}", stem, k);
  return folder;
}

/// @return a name as a line of text can hold it
std::string shortened(const std::string& name) {
  constexpr std::size_t kMost = 60;
  return name.size() <= kMost ? name : name.substr(0, kMost) + "...";
}

nlohmann::ordered_json number(double x) {
  return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json to_json(const Figure& figure) {
  if (const double* x = std::get_if<double>(&figure)) return number(*x);
  auto list = nlohmann::ordered_json::array();
  for (const double x : std::get<std::vector<double>>(figure)) list.push_back(number(x));
  return list;
}

nlohmann::ordered_json to_json(const Fault& fault) {
  return {{"class", to_string(class_of(fault.code))},
          {"code", to_string(fault.code)},
          {"process", fault.process.view()},
          {"text", what_happened(fault)}};
}

}  // namespace

fs::path name_run_folder(const fs::path& wanted, const std::string& task) {
  fs::path folder = wanted.empty() ? fresh_name(task) : wanted;
  std::error_code error;
  const bool there = fs::exists(folder, error);
  if (error)
    throw FaultError(
        error == std::errc::filename_too_long ? FaultCode::bad_usage : FaultCode::cannot_write,
        fmt::format("{} cannot be a run folder: {}", shortened(folder.string()), error.message()),
        "choose another --run-dir");
  if (there && !fs::is_empty(folder, error))
    throw FaultError(FaultCode::bad_usage,
                     fmt::format("{} {}", folder.string(),
                                 fs::exists(folder / "config.toml", error) ? "holds a run already"
                                 : fs::is_directory(folder, error)         ? "is not empty"
                                                                   : "is a file, and a folder is wanted"),
                     "choose another --run-dir or delete it");
  return folder;
}

void make_run_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder / "plots", error);
  if (error)
    throw FaultError(FaultCode::cannot_write,
                     fmt::format("cannot make {}: {}", folder.string(), error.message()));
}

void discard_run_folder(const fs::path& folder) noexcept {
  std::error_code ignored;
  if (fs::exists(folder / "config.toml", ignored)) fs::remove_all(folder, ignored);
}

void write_summary(const fs::path& folder, const Summary& s) {
  nlohmann::ordered_json json;
  json["task"] = s.task;
  json["outcome"] = s.stopped ? "stopped" : s.fault ? "fault" : "done";
  json["fault"] = nullptr;
  if (s.fault) json["fault"] = to_json(*s.fault);
  for (const RecoverableFault& recovered : s.survived) {
    json["survived"].push_back(to_json(recovered.fault));
    json["survived"].back()["sim_s"] = recovered.sim_s;
  }
  if (!s.black_box.empty()) json["black_box"] = s.black_box;
  json["sim_s"] = s.sim_s;
  json["wall_s"] = s.wall_s;
  json["real_time_factor"] = s.wall_s > 0 ? s.sim_s / s.wall_s : 0;
  json["log_hash"] = fmt::format("{:016x}", s.log_hash);
  json["figures"] = nlohmann::ordered_json::object();
  for (const auto& [key, figure] : s.figures) json["figures"][key] = to_json(figure);
  json["wanted"] = nlohmann::ordered_json::object();
  for (const auto& [key, bounds] : s.wanted) json["wanted"][key] = {number(bounds.low), number(bounds.high)};
  // Texts of faults can come from anywhere: bytes that are no UTF-8 are replaced.
  const std::string text = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  // One that is there already stays whole if this one cannot be written.
  const fs::path written = folder / "summary.json.new";
  std::error_code error;
  try {
    write_text(written, text + "\n");
  } catch (const FaultError&) {
    fs::remove(written, error);
    throw;
  }
  fs::rename(written, folder / "summary.json", error);
  if (error)
    throw FaultError(FaultCode::cannot_write,
                     fmt::format("cannot write {}", (folder / "summary.json").string()));
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw FaultError(FaultCode::cannot_write, fmt::format("cannot write {}", file.string()));
}

}  // namespace mrroc::mp
