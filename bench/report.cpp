#include "bench/report.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/fault.hpp"

namespace mrroc::bench {
using Json = nlohmann::json;

void Report::resume() {
  std::ifstream stream(file_);
  if (!stream) return;
  const Json old = Json::parse(stream, nullptr, false);
  try {
    for (const Json& group : old.at("groups")) {
      auto& [name, values] =
          groups_.emplace_back(group.at("name").get<std::string>(), std::map<std::string, double>{});
      for (const auto& [key, value] : group.at("figures").items())
        values[key] = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
    }
  } catch (const Json::exception&) {
    throw FaultError(FaultCode::bad_usage, file_.string() + " is not a report of the benchmarks");
  }
}

bool Report::has(const std::string& group) const {
  return std::ranges::any_of(groups_, [&](const auto& g) { return g.first == group; });
}

void Report::add(const std::string& group, const Figures& figures) {
  auto& [name, values] = groups_.emplace_back(group, std::map<std::string, double>{});
  fmt::print("\n{}\n", name);
  for (const Figure& f : figures) {
    values[f.key] = f.value;
    fmt::print("  {:22} {:>10.4g} {:6} {}\n", f.key, f.value, f.unit, f.about);
  }
  std::fflush(stdout);
  if (file_.empty()) return;
  std::ofstream stream(file_);
  stream << json();
  if (!stream.flush()) throw FaultError(FaultCode::cannot_write, "cannot write " + file_.string());
}

std::string Report::json() const {
  std::map<std::string, double> figures;
  Json groups = Json::array();
  for (const auto& [name, values] : groups_) {
    figures.insert(values.begin(), values.end());
    groups.push_back({{"name", name}, {"figures", values}});
  }
  Json report;
  report["figures"] = figures;
  report["groups"] = groups;
  report["context"] = {{"compiler", MRROC_COMPILER},
                       {"build_type", MRROC_BUILD_TYPE},
                       {"flags", MRROC_FLAGS},
                       {"cores", std::thread::hardware_concurrency()},
                       {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
  return report.dump(2) + "\n";
}

}  // namespace mrroc::bench
