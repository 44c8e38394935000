#include "bench/report.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdio>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/fault.hpp"

namespace mrroc::bench {
using nlohmann::json;

void Report::resume() {
  std::ifstream stream(file_);
  if (!stream) return;
  const json old = json::parse(stream, nullptr, false);
  try {
    for (const auto& [key, value] : old.at("figures").items()) figures_[key] = value.get<double>();
    for (const json& group : old.at("context").at("groups")) groups_.insert(group.get<std::string>());
  } catch (const json::exception&) {
    throw FaultError(FaultCode::bad_usage, file_.string() + " is not a report of the benchmarks");
  }
}

void Report::add(const std::string& group, const Figures& figures) {
  groups_.insert(group);
  fmt::print("\n{}\n", group);
  for (const Figure& f : figures) {
    figures_[f.key] = f.value;
    fmt::print("  {:22} {:>10.4g} {:6} {}\n", f.key, f.value, f.unit, f.about);
  }
  std::fflush(stdout);
  if (!file_.empty()) write();
}

void Report::write() const {
  json report;
  report["figures"] = figures_;
  report["context"] = {{"groups", groups_},
                       {"compiler", MRROC_COMPILER},
                       {"build_type", MRROC_BUILD_TYPE},
                       {"flags", MRROC_FLAGS},
                       {"cores", std::thread::hardware_concurrency()},
                       {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
  std::ofstream stream(file_);
  stream << report.dump(2) << '\n';
  if (!stream.flush()) throw FaultError(FaultCode::cannot_write, "cannot write " + file_.string());
}

}  // namespace mrroc::bench
