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

using Column = std::string ConfigParameter::*;

/// @param columns  as wide as what they hold, but the last one
std::string table_of(const std::vector<ConfigParameter>& rows, const std::vector<Column>& columns) {
  constexpr std::size_t kWidest = 44;  // a longer one does not push the others aside
  const auto width = [&](Column column) {
    std::size_t widest = 0;
    for (const ConfigParameter& p : rows)
      if ((p.*column).size() <= kWidest) widest = std::max(widest, (p.*column).size());
    return widest;
  };
  std::vector<std::size_t> widths;
  for (const Column column : columns) widths.push_back(width(column));
  std::string table;
  for (const ConfigParameter& p : rows) {
    std::string line;
    for (std::size_t k = 0; k < columns.size(); ++k) line += fmt::format("{:{}}  ", p.*columns[k], widths[k]);
    line.erase(line.find_last_not_of(' ') + 1);
    table += line + "\n";
  }
  return table;
}

/// @return what is true of the plant; how fast it is simulated is no matter of it
std::vector<ConfigParameter> true_parameters(const Config& config) {
  std::vector<ConfigParameter> all = settable(config);
  std::erase_if(all, [](const ConfigParameter& p) { return !p.key.starts_with("sim."); });
  return all;
}

nlohmann::ordered_json or_null(const std::string& text) {
  return text.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(text);
}

std::string text_of(const nlohmann::ordered_json& list) {
  return list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string parameter_table(const Config& config, const std::string& value_name) {
  std::vector<ConfigParameter> rows = settable(config);
  rows.insert(rows.begin(), {.key = "key", .value = value_name, .range = "range", .unit = "unit"});
  return table_of(rows, {&ConfigParameter::key, &ConfigParameter::value, &ConfigParameter::range,
                         &ConfigParameter::unit});
}

std::string truth_table(const Config& config, const std::string& value_name) {
  std::vector<ConfigParameter> rows = true_parameters(config);
  rows.insert(rows.begin(), {.key = "key",
                             .value = value_name,
                             .range = "range",
                             .unit = "unit",
                             .about = "meaning",
                             .believed = "believed"});
  return table_of(rows, {&ConfigParameter::key, &ConfigParameter::unit, &ConfigParameter::value,
                         &ConfigParameter::range, &ConfigParameter::believed, &ConfigParameter::about});
}

std::string parameter_json(const Config& config, const std::string& value_name) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ConfigParameter& p : settable(config))
    list.push_back(
        {{"key", p.key}, {value_name, p.value}, {"range", or_null(p.range)}, {"unit", or_null(p.unit)}});
  return text_of(list);
}

std::string truth_json(const Config& config, const std::string& value_name) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ConfigParameter& p : true_parameters(config))
    list.push_back({{"key", p.key},
                    {"unit", or_null(p.unit)},
                    {value_name, p.value},
                    {"range", or_null(p.range)},
                    {"believed", or_null(p.believed)},
                    {"meaning", or_null(p.about)}});
  return text_of(list);
}

int list_parameters(const Config& config, const TaskOptions& options) {
  const bool given = !options.settings.empty() || !options.config_file.empty() || options.seed_asked;
  const std::string value = given ? "value" : "default";
  if (options.truth)
    print(stdout, options.json ? truth_json(config, value) : truth_table(config, value));
  else
    print(stdout, options.json ? parameter_json(config, value) : parameter_table(config, value));
  return 0;
}

}  // namespace mrroc::mp
