#include "mp/parameter_list.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/print.hpp"

namespace mrroc::mp {
namespace {

std::vector<ConfigParameter> settable(const Config& config) {
  constexpr std::array<std::string_view, 3> kOfOptions{"run.folder", "run.strokes", "sim.speed"};
  std::vector<ConfigParameter> all = config.parameters();
  std::erase_if(all, [&](const ConfigParameter& p) {
    return std::ranges::find(kOfOptions, p.key) != kOfOptions.end();
  });
  std::stable_partition(all.begin(), all.end(),  // the one of std::ranges does not compile with clang 14
                        [](const ConfigParameter& p) { return p.key.starts_with("task."); });
  return all;
}

}  // namespace

std::string parameter_table(const Config& config, const std::string& value_name) {
  constexpr std::size_t kWidest = 44;  // a longer one does not push the others aside
  std::vector<ConfigParameter> rows = settable(config);
  rows.insert(rows.begin(), {.key = "key", .value = value_name, .range = "range", .unit = "unit"});
  const auto width = [&](std::string ConfigParameter::*column) {
    std::size_t widest = 0;
    for (const ConfigParameter& p : rows)
      if ((p.*column).size() <= kWidest) widest = std::max(widest, (p.*column).size());
    return widest;
  };
  const std::size_t key = width(&ConfigParameter::key), value = width(&ConfigParameter::value),
                    range = width(&ConfigParameter::range);
  std::string table;
  for (const ConfigParameter& p : rows) {
    std::string line =
        fmt::format("{:{}}  {:{}}  {:{}}  {}", p.key, key, p.value, value, p.range, range, p.unit);
    line.erase(line.find_last_not_of(' ') + 1);
    table += line + "\n";
  }
  return table;
}

std::string parameter_json(const Config& config, const std::string& value_name) {
  using Json = nlohmann::ordered_json;
  const auto or_null = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  Json list = Json::array();
  for (const ConfigParameter& p : settable(config))
    list.push_back(
        {{"key", p.key}, {value_name, p.value}, {"range", or_null(p.range)}, {"unit", or_null(p.unit)}});
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

int list_parameters(const Config& config, const TaskOptions& options) {
  const bool given = !options.settings.empty() || !options.config_file.empty() || options.seed_asked;
  const std::string value = given ? "value" : "default";
  print(stdout, options.json ? parameter_json(config, value) : parameter_table(config, value));
  return 0;
}

}  // namespace mrroc::mp
