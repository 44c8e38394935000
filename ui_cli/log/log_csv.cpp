#include "ui_cli/log/log_csv.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/fault.hpp"

namespace mrroc::ui {
namespace {

using Json = nlohmann::ordered_json;

bool chosen(const std::string& name, const std::vector<std::string>& wanted) {
  return wanted.empty() || std::ranges::any_of(wanted, [&](const std::string& w) {
           return name == w || (name.starts_with(w) && (name[w.size()] == '[' || name[w.size()] == '.'));
         });
}

std::vector<Field> columns_of(const MessageType& type, const std::vector<std::string>& wanted) {
  std::vector<Field> columns;
  for (const Field& f : type.fields)
    if (chosen(f.name, wanted)) columns.push_back(f);
  if (columns.empty()) throw FaultError(FaultCode::bad_usage, fmt::format("{} has no such field", type.name));
  return columns;
}

/// A field as it stands in the table: texts with doubled quotation marks, as CSV has them.
std::string cell(std::span<const std::uint8_t> bytes, const Field& f) {
  std::string value = value_in(bytes, f);
  if (f.kind != FieldKind::text) return value;
  for (std::size_t at = value.find("\\\""); at != std::string::npos; at = value.find("\\\"", at + 2))
    value[at] = '"';
  return value;
}

void write_row(const RunRecord& run, const link::LoggedMessage& m, const std::vector<Field>& columns,
               std::ostream& out) {
  const auto t = run.time_of(m);
  out << (t ? fmt::format("{:.6g}", *t) : "");
  for (const Field& f : columns) out << "," << cell(m.bytes, f);
  out << "\n";
}

Json row_json(const RunRecord& run, const link::LoggedMessage& m, const std::vector<Field>& columns) {
  Json row{{"t", nullptr}};
  if (const auto t = run.time_of(m)) row["t"] = *t;
  for (const Field& f : columns) {
    const std::string value = value_in(m.bytes, f);
    const Json parsed = Json::parse(value, nullptr, false);
    row[f.name] = parsed.is_discarded() ? Json(nullptr) : parsed;  // nan and inf are not JSON
  }
  return row;
}

}  // namespace

void write_channel(const RunRecord& run, const std::string& channel, const std::vector<std::string>& fields,
                   bool json, std::ostream& out) {
  check_channel(run, channel);
  std::vector<Field> columns;
  const MessageType* of_all = nullptr;
  Json rows = Json::array();
  for (const link::LoggedMessage& m : run.log().messages()) {
    if (m.channel != channel) continue;
    const MessageType* const type = type_of(m.bytes);
    if (!of_all && type) {
      of_all = type;
      columns = columns_of(*type, fields);
      if (!json) out << "t";
      if (!json)
        for (const Field& f : columns) out << "," << f.name;
      if (!json) out << "\n";
    }
    if (!type || type != of_all) continue;
    if (json)
      rows.push_back(row_json(run, m, columns));
    else
      write_row(run, m, columns, out);
  }
  if (!of_all)
    throw FaultError(FaultCode::bad_log,
                     fmt::format("the messages of {} are of another version of the framework", channel));
  if (json) out << rows.dump(-1, ' ', false, Json::error_handler_t::replace) << "\n";
}

void write_channels(const RunRecord& run, bool json, std::ostream& out) {
  struct Told {
    std::string type;
    std::int64_t count{};
    std::optional<double> first, last;
  };
  std::map<std::string, Told> all;
  for (const link::LoggedMessage& m : run.log().messages()) {
    Told& told = all[m.channel];
    const MessageType* const type = type_of(m.bytes);
    told.type = type ? type->name : "?";
    ++told.count;
    told.last = run.time_of(m);
    if (!told.first) told.first = told.last;
  }
  const auto time = [](const std::optional<double>& t) { return t ? fmt::format("{:.3f}", *t) : "-"; };
  Json list = Json::array();
  if (!json)
    out << fmt::format("{:<22} {:<20} {:>8} {:>9} {:>9}\n", "CHANNEL", "TYPE", "MESSAGES", "FROM [s]",
                       "TO [s]");
  for (const auto& [name, told] : all) {
    if (json)
      list.push_back({{"channel", name}, {"type", told.type}, {"messages", told.count}});
    else
      out << fmt::format("{:<22} {:<20} {:>8} {:>9} {:>9}\n", name, told.type, told.count, time(told.first),
                         time(told.last));
  }
  if (json) out << list.dump(2) << "\n";
}

}  // namespace mrroc::ui
