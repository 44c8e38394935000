#include "ui_cli/log/log_show.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ostream>

#include "base/counted.hpp"
#include "base/fault.hpp"
#include "base/link/text.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/convert_platform.hpp"
#include "mrroc/console_t.hpp"
#include "mrroc/operator_image_t.hpp"
#include "mrroc/process_status_t.hpp"
#include "mrroc/task_status_t.hpp"
#include "ui_cli/json_file.hpp"
#include "ui_cli/log/behaviour_names.hpp"

namespace mrroc::ui {
namespace {

using Json = nlohmann::ordered_json;

/// One line of the story.
struct Line {
  std::int64_t i{};  ///< macrostep
  std::string who;   ///< arm1, operator, a process
  std::string what;
  bool change{};
};

class Story {
 public:
  explicit Story(const RunRecord& run) : run_(run), names_(run) {}

  [[nodiscard]] const std::string& missing_names() const { return names_.missing(); }

  std::vector<Line> lines() {
    for (const std::string& agent : run_.agents()) add_agent(agent);
    add_operator();
    for (const link::LoggedMessage& m : run_.log().messages())
      if (m.channel.ends_with(".console"))
        if (const auto c = link::decode<console_t>(m.bytes)) add_console(*c);
    std::ranges::stable_sort(lines_, {}, &Line::i);
    return std::move(lines_);
  }

 private:
  /// @return the behaviour as the agent calls it: its numbers are its own, the coordinator's mean something else
  [[nodiscard]] std::string name(const std::string& arm, int m) const {
    const std::string known = names_.name(arm, m);
    return fmt::format("m = {}{}{}", m, known.empty() ? "" : ", ", known);
  }

  void add_agent(const std::string& agent) {
    const Effector effector = run_.effector_of(agent);
    std::optional<Report> before;
    for (const auto& [stamp, message] : run_.log().messages<agent_report_t>(agent + ".report")) {
      const Report r = from_message(message);
      if (!before || r.m != before->m) add(stamp, agent, "behaviour " + name(agent, r.m));
      if (effector != Effector::none && (!before || r.driver_state != before->driver_state))
        add(stamp, agent, fmt::format("driver {}", to_string(r.driver_state)));
      const bool wrong = r.verdict == Verdict::refused || r.verdict == Verdict::failed;
      if (wrong && (!before || r.fault.code != before->fault.code || before->verdict != r.verdict))
        add(stamp, agent,
            fmt::format("command {}: {}", r.verdict == Verdict::refused ? "refused" : "failed",
                        describe(r.fault)));
      before = r;
      if (effector == Effector::arm) lines_.push_back({stamp, agent, arm_line(r), false});
      if (effector == Effector::none) lines_.push_back({stamp, agent, fmt::format("m {:2}", r.m), false});
    }
    if (effector == Effector::platform) add_platform(agent);
  }

  static std::string arm_line(const Report& r) {
    return fmt::format("m {:2}  {:11}  x y z {:8.2f} {:8.2f} {:8.2f} mm  F {:7.2f} {:7.2f} {:7.2f} N", r.m,
                       to_string(r.driver_state), 1e3 * r.T_0E[0], 1e3 * r.T_0E[1], 1e3 * r.T_0E[2],
                       r.F_a[Axis::x], r.F_a[Axis::y], r.F_a[Axis::z]);
  }

  void add_platform(const std::string& key) {
    constexpr double kDegrees = 180 / std::numbers::pi;
    for (const auto& [stamp, message] : run_.log().messages<platform_reply_t>(key + ".reply")) {
      const PlatformReply r = from_message(message);
      const auto& [x, y, phi] = r.estimate.p;
      std::string line = fmt::format("{:11}  ", to_string(r.state));
      if (r.position_known)
        line += fmt::format("x y {:8.1f} {:8.1f} mm  phi {:6.1f} deg  v {:6.3f} m/s  mu {:5.2f} {:5.2f}  ",
                            1e3 * x, 1e3 * y, kDegrees * phi, r.estimate.v.vx, r.slip.mu_x, r.slip.mu_y);
      line += r.executing > 0 ? fmt::format("fragment {}", r.executing) : "no fragment";
      lines_.push_back({stamp, key, line, false});
    }
  }

  void add_operator() {
    operator_image_t before{};
    for (const auto& [stamp, h] : run_.log().messages<operator_image_t>("operator.image")) {
      if (h.started != before.started) add(stamp, "operator", "start");
      if (h.paused != before.paused) add(stamp, "operator", h.paused ? "pause" : "resume");
      if (h.trigger != before.trigger) add(stamp, "operator", fmt::format("trigger {}", h.trigger));
      before = h;
    }
  }

  void add_console(const console_t& c) {
    const FaultCode code = fault_code(c.code).value_or(FaultCode::none);
    const std::string text = link::get_text(c.text);
    add(c.header.stamp, link::get_text(c.process),
        code == FaultCode::none ? text : fmt::format("{}: {}", to_string(code), text));
  }

  void add(std::int64_t i, const std::string& who, const std::string& what) {
    lines_.push_back({i, who, what, true});
  }

  const RunRecord& run_;
  BehaviourNames names_;
  std::vector<Line> lines_;
};

void show_story(const RunRecord& run, const ShowOptions& o, std::ostream& out, std::ostream& err) {
  Story story(run);
  if (!story.missing_names().empty()) err << "warning: " << story.missing_names() << std::endl;
  for (const Line& line : story.lines()) {
    const double t = static_cast<double>(line.i) * run.macrostep_s();
    if (t < o.from || t > o.to || (o.changes && !line.change)) continue;
    if (o.json)
      out << Json{{"t", t}, {"i", line.i}, {"who", line.who}, {"what", line.what}, {"change", line.change}}
                 .dump(-1, ' ', false, Json::error_handler_t::replace)
          << "\n";
    else
      out << fmt::format("{:9.3f} s {:6}  {} {:<10} {}\n", t, line.i, line.change ? '*' : ' ', line.who,
                         line.what);
  }
}

/// @return the last line of a file; empty: there is none
std::string last_line(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) last = line;
  return last;
}

/// The end of the run, from its summary; where it has none, the last message that an operator has seen.
void show_outcome(const RunRecord& run, bool json, std::ostream& out) {
  const auto summary = json_file<Json>(run.folder() / "summary.json");
  const bool told = summary.is_object() && summary.contains("outcome") && summary["outcome"].is_string();
  Json outcome{{"outcome", told ? summary["outcome"] : Json(nullptr)}, {"fault", nullptr}};
  std::string text = told ? summary["outcome"].get<std::string>()
                          : "not told, the run has no summary: it was ended from outside, or still goes on";
  if (told && summary.contains("fault") && summary["fault"].is_object()) {
    outcome["fault"] = summary["fault"];
    for (const auto& [key, between] : {std::pair{"code", ", "}, {"process", ", "}, {"text", ": "}})
      if (const Json part = summary["fault"].value(key, Json());
          part.is_string() && !part.get_ref<const std::string&>().empty())
        text += between + part.get<std::string>();
  } else if (!told) {
    const std::string last = last_line(run.folder() / "messages.log");
    outcome["last_message"] = last;
    if (!last.empty()) text += "; its last message: " + last;
  }
  if (const std::int64_t damaged = run.log().damaged(); damaged > 0) {
    outcome["damaged"] = damaged;
    text +=
        fmt::format("; the log is damaged in {}, what stood there is left out", counted(damaged, "place"));
  }
  out << (json ? outcome.dump(-1, ' ', false, Json::error_handler_t::replace) : "outcome: " + text) << "\n";
}

Json value_of(const link::LoggedMessage& m, const Field& f) {
  if (f.kind == FieldKind::text) {
    const std::string quoted = value_in(m.bytes, f);
    return quoted.substr(1, quoted.size() - 2);
  }
  const double x = number_in(m.bytes, f);
  if (f.kind == FieldKind::float32 || f.kind == FieldKind::float64)
    return std::isfinite(x) ? Json(x) : Json(nullptr);
  return Json::parse(value_in(m.bytes, f));
}

Json message_json(const link::LoggedMessage& m, const std::optional<double>& t) {
  Json j{{"t", nullptr}};
  if (t) j["t"] = *t;
  if (const MessageType* const type = type_of(m.bytes))
    for (const Field& f : type->fields) j[f.name] = value_of(m, f);
  return j;
}

void show_channel(const RunRecord& run, const ShowOptions& o, std::ostream& out) {
  for (const link::LoggedMessage& m : run.log().messages()) {
    if (m.channel != o.channel) continue;
    const auto t = run.time_of(m);
    if (t ? *t < o.from || *t > o.to : o.from > 0) continue;
    const link::RawHeader h = link::header_of(m.bytes);
    if (o.json)
      out << message_json(m, t).dump(-1, ' ', false, Json::error_handler_t::replace) << "\n";
    else
      out << fmt::format("{}  number {} stamp {}  {}\n", t ? fmt::format("{:9.3f} s", *t) : "        -  ",
                         h.number, h.stamp, message_text(m));
  }
}

}  // namespace

void show_log(const RunRecord& run, const ShowOptions& options, std::ostream& out, std::ostream& err) {
  if (options.channel.empty()) {
    show_story(run, options, out, err);
    if (std::isinf(options.to)) show_outcome(run, options.json, out);
    return;
  }
  check_channel(run, options.channel);
  show_channel(run, options, out);
}

}  // namespace mrroc::ui
