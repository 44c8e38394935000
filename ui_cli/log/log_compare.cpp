#include "ui_cli/log/log_compare.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "base/counted.hpp"

#include "ui_cli/json_file.hpp"

namespace mrroc::ui {
namespace {

using Json = nlohmann::ordered_json;

/// The bytes without the number of the session, which differs from run to run.
std::vector<std::uint8_t> without_session(std::vector<std::uint8_t> bytes) {
  constexpr std::size_t kAt = 8, kSize = 8;
  if (bytes.size() >= kAt + kSize) std::fill_n(bytes.begin() + kAt, kSize, std::uint8_t{0});
  return bytes;
}

Json summary_of(const RunRecord& run) { return json_file<Json>(run.folder() / "summary.json"); }

void put_figures(const Json& summary, bool first,
                 std::map<std::string, std::pair<std::string, std::string>>& figures) {
  const auto put = [&](const std::string& key, const Json& value) {
    auto& [a, b] = figures.try_emplace(key, "-", "-").first->second;
    (first ? a : b) = value.is_string() ? value.get<std::string>() : value.dump();
  };
  if (!summary.is_object()) return;
  for (const char* key : {"outcome", "sim_s", "log_hash"})
    if (summary.contains(key)) put(key, summary[key]);
  if (summary.contains("figures"))
    for (const auto& [key, value] : summary["figures"].items()) put(key, value);
}

}  // namespace

Comparison compare_runs(const RunRecord& a, const RunRecord& b) {
  using Key = std::pair<std::string, std::int64_t>;
  const auto key_of = [](const link::LoggedMessage& m) {
    return Key{m.channel, link::header_of(m.bytes).number};
  };
  std::map<Key, const link::LoggedMessage*> of_b;
  for (const link::LoggedMessage& m : b.log().messages())
    if (!by_wall_clock(m.channel)) of_b[key_of(m)] = &m;
  Comparison c{.task_a = a.task(), .task_b = b.task()};
  const auto note = [&](link::LogDifference d) {
    ++c.differences;
    if (!c.first) c.first = std::move(d);
  };
  const auto lacking = [](const link::LoggedMessage& m, const char* in_a, const char* in_b) {
    const link::RawHeader h = link::header_of(m.bytes);
    link::LogDifference d;
    d.channel = m.channel;
    d.number = h.number;
    d.stamp = h.stamp;
    d.logged = in_a;
    d.recomputed = in_b;
    return d;
  };
  std::set<Key> seen;  // a message that was sent again stands in the log twice
  for (const link::LoggedMessage& m : a.log().messages()) {
    if (by_wall_clock(m.channel) || !seen.insert(key_of(m)).second) continue;
    ++c.compared;
    const auto found = of_b.find(key_of(m));
    if (found == of_b.end()) {
      ++c.only_a;
      note(lacking(m, "a message", "nothing"));
      continue;
    }
    if (auto d = link::difference(m.channel, without_session(m.bytes), without_session(found->second->bytes)))
      note(std::move(*d));
    of_b.erase(found);
  }
  for (const auto& [key, message] : of_b) note(lacking(*message, "nothing", "a message"));
  c.only_b = static_cast<std::int64_t>(of_b.size());
  c.compared += c.only_b;
  put_figures(summary_of(a), true, c.figures);
  put_figures(summary_of(b), false, c.figures);
  return c;
}

int report_comparison(const Comparison& c, bool json, std::ostream& out) {
  if (json) {
    Json j{{"compared", c.compared},
           {"differences", c.differences},
           {"only_in_a", c.only_a},
           {"only_in_b", c.only_b},
           {"first", nullptr}};
    if (c.first)
      j["first"] = {{"channel", c.first->channel}, {"number", c.first->number}, {"stamp", c.first->stamp},
                    {"field", c.first->field},     {"a", c.first->logged},      {"b", c.first->recomputed}};
    for (const auto& [key, values] : c.figures) j["figures"][key] = {values.first, values.second};
    out << j.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
    return c.differences > 0 ? 1 : 0;
  }
  if (c.task_a != c.task_b) out << fmt::format("two tasks: A is a run of {}, B of {}\n", c.task_a, c.task_b);
  out << fmt::format("{} compared, {} {}", counted(c.compared, "message"), c.differences,
                     c.differences == 1 ? "differs" : "differ");
  if (c.only_a + c.only_b > 0) out << fmt::format(": {} only in A, {} only in B", c.only_a, c.only_b);
  out << "\n";
  if (c.first)
    out << fmt::format("first: {}, message {}, for step {}{}\n  A: {}\n  B: {}\n", c.first->channel,
                       c.first->number, c.first->stamp,
                       c.first->field.empty() ? "" : fmt::format(", field {}", c.first->field),
                       c.first->logged, c.first->recomputed);
  if (!c.figures.empty()) out << fmt::format("\n{:<26} {:>28} {:>28}\n", "FIGURE", "A", "B");
  for (const auto& [key, values] : c.figures)
    out << fmt::format("{:<26} {:>28} {:>28}{}\n", key, values.first, values.second,
                       values.first == values.second ? "" : "  *");
  return c.differences > 0 ? 1 : 0;
}

}  // namespace mrroc::ui
