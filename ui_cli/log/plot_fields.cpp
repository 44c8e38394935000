#include "ui_cli/log/plot_fields.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <type_traits>

#include "base/agent_images.hpp"
#include "base/closest_match.hpp"
#include "base/effector_command.hpp"
#include "base/fault.hpp"
#include "base/joined.hpp"
#include "base/latency.hpp"
#include "base/pose.hpp"
#include "base/screw.hpp"
#include "mrroc/effector_command_t.hpp"

namespace mrroc::ui {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// Says whether a command sets the bias of the force sensor, by itself or with the force tool.
bool biases(const effector_command_t& c) {
  const auto set = static_cast<std::uint8_t>(c.set);
  return has(set, Part::force_bias) || (has(set, Part::robot_model) && c.robot_model.set_force_tool != 0);
}

double value_of(const agent_report_t& r, const PlotField& f, const Pose& first) {
  switch (f.source) {
    case FieldSource::force:
      return r.F_a[f.index];
    case FieldSource::displacement:
      return r.T_0E[f.index] - first.p[static_cast<Eigen::Index>(f.index)];
    case FieldSource::rotation: {
      const Twist turned = log_screw({first.R.transpose() * pose_of(r).R, Vector3::Zero()});
      return turned.v[3 + f.index];
    }
    case FieldSource::pose:
      return r.T_0E[f.index];
    case FieldSource::gripper:
      return r.gripper;
    default:
      return r.m;
  }
}

double value_of(const effector_reply_t& r, const PlotField& f, const effector_reply_t& first) {
  switch (f.source) {
    case FieldSource::turned:
      return r.motors[f.index] - first.motors[f.index];
    case FieldSource::joints:
      return r.joints[f.index];
    case FieldSource::current:
      return r.current_mean[f.index];
    default:
      return r.motors[f.index];
  }
}

/// Fields that differ in their component only.
struct Family {
  const char* subject;
  const char* name;        // * stands for x, y or z, # for the component's number
  const char* alias;       // the same
  std::size_t begin, end;  // components
  bool of_axes;            // as many as the arm has axes
  const char* quantity;
  const char* unit;
  FieldSource source;
  double scale;
  bool usual;
};

constexpr std::size_t kMostAxes = std::extent_v<decltype(effector_reply_t::motors)>;

using enum FieldSource;
// clang-format off
constexpr std::array kFamilies{
    Family{"force", "F_*", "F_a[#]", 0, 3, false, "force F_a in E", "N", force, 1, true},
    Family{"force", "N_*", "F_a[#]", 3, 6, false, "moment of F_a in E", "N m", force, 1, false},
    Family{"pose", "*", "", 0, 3, false, "displacement of E along the axes of the base", "mm", displacement, 1e3, true},
    Family{"pose", "r*", "", 0, 3, false, "rotation of E about its axes at the beginning", "deg", rotation, kDegrees, false},
    Family{"pose", "T_0E[#]", "", 0, 3, false, "position of E in the base", "m", pose, 1, false},
    Family{"pose", "T_0E[#]", "", 3, 6, false, "angle-axis of E in the base", "rad", pose, 1, false},
    Family{"pose", "gripper", "", 0, 1, false, "distance of the jaws", "mm", gripper, 1e3, false},
    Family{"motors", "turned[#]", "", 0, 0, true, "turn of the motors since the first reading", "rad", turned, 1, true},
    Family{"motors", "motors[#]", "", 0, 0, true, "positions of the motors", "rad", motors, 1, false},
    Family{"motors", "joints[#]", "", 0, 0, true, "positions of the joints", "rad, m", joints, 1, false},
    Family{"motors", "current_mean[#]", "", 0, 0, true, "mean currents of the motors", "A", current, 1, false},
    Family{"behaviours", "m", "", 0, 1, false, "behaviours", "", behaviour, 1, true}};
// clang-format on

/// @return a name of a family, for one component
std::string named(std::string_view pattern, std::size_t k, std::size_t begin) {
  std::string name;
  for (const char c : pattern)
    name += c == '*' ? std::string(1, "xyz"[k - begin]) : c == '#' ? std::to_string(k) : std::string(1, c);
  return name;
}

bool is_called(const PlotField& f, const std::string& word) {
  return f.name == word || f.alias == word || f.name.starts_with(word + "[") ||
         f.alias.starts_with(word + "[");
}

}  // namespace

bool of_axis(const PlotField& f) { return f.source >= FieldSource::turned; }

const std::vector<std::string>& arm_subjects() {
  static const std::vector<std::string> names{"force", "pose", "motors", "behaviours"};
  return names;
}

std::vector<PlotField> plot_fields(const std::string& subject, std::size_t axes) {
  std::vector<PlotField> all;
  for (const Family& family : kFamilies) {
    if (!subject.empty() && subject != family.subject) continue;
    const std::size_t end = family.of_axes ? std::min(axes, kMostAxes) : family.end;
    for (std::size_t k = family.begin; k < end; ++k)
      all.push_back({.name = named(family.name, k, family.begin),
                     .alias = named(family.alias, k, family.begin),
                     .subject = family.subject,
                     .quantity = family.quantity,
                     .unit = family.unit,
                     .source = family.source,
                     .index = k,
                     .scale = family.scale,
                     .usual = family.usual});
  }
  return all;
}

std::vector<PlotField> chosen_fields(const std::vector<PlotField>& known,
                                     const std::vector<std::string>& wanted) {
  for (const std::string& word : wanted) {
    if (std::ranges::any_of(known, [&](const PlotField& f) { return is_called(f, word); })) continue;
    std::vector<std::string> names;
    WordSet candidates;
    for (const PlotField& f : known) {
      names.push_back(f.name);
      candidates.insert({f.name, f.alias.empty() ? f.name : f.alias});
    }
    throw FaultError(FaultCode::bad_usage,
                     fmt::format("there is no field '{}' to draw{}", word, did_you_mean(word, candidates)),
                     "fields: " + joined(names, ", "));
  }
  std::vector<PlotField> chosen;
  for (const PlotField& f : known)
    if (wanted.empty() ? f.usual
                       : std::ranges::any_of(wanted, [&](const std::string& w) { return is_called(f, w); }))
      chosen.push_back(f);
  return chosen;
}

ArmReadings::ArmReadings(const RunRecord& run, const std::string& arm)
    : macrostep_s_(run.macrostep_s()),
      reports_(run.log().messages<agent_report_t>(arm + ".report")),
      replies_(run.log().messages<effector_reply_t>(arm + ".reply")) {
  std::erase_if(reports_, [](const auto& r) { return r.second.position_known == 0; });
  for (const auto& [stamp, r] : replies_) {
    // Which motors have a servo algorithm; of an older log, which motors ever were anywhere.
    const auto told = static_cast<std::uint8_t>(r.robot_model.set_servo_algorithm);
    axes_ = std::max(axes_, static_cast<std::size_t>(std::bit_width(told)));
  }
  for (const auto& [stamp, r] : replies_)
    for (std::size_t k = axes_; k < std::size(r.motors); ++k)
      if (r.motors[k] != 0) axes_ = k + 1;
  // A driver that has been left, and one that has measured nothing, tell zeros.
  std::erase_if(replies_, [](const auto& r) { return std::ranges::count(r.second.motors, 0) == kMaxAxes; });
  // Stamp of the first report that has a reading made with it; the command is stamped with its macrostep.
  constexpr std::int64_t kAnswered = latency::kMotionToReport + latency::kMessage;
  for (const auto& [stamp, c] : run.log().messages<effector_command_t>(arm + ".command"))
    if (biases(c)) {
      biased_at_ = static_cast<double>(stamp + kAnswered) * macrostep_s_;
      return;
    }
  const auto ready = std::ranges::find_if(reports_, [](const auto& r) { return r.second.ready != 0; });
  if (ready != reports_.end()) biased_at_ = static_cast<double>(ready->first) * macrostep_s_;
}

std::vector<Sample> ArmReadings::readings(const PlotField& field, double from, double to) const {
  std::vector<Sample> samples;
  const auto add = [&](std::int64_t stamp, auto value) {
    const double t = static_cast<double>(stamp) * macrostep_s_;
    if (t >= from && t <= to) samples.push_back({t, field.scale * value()});
  };
  if (of_axis(field)) {
    const effector_reply_t* first = nullptr;
    for (const auto& [stamp, r] : replies_)
      add(stamp, [&, &r = r] {
        if (!first) first = &r;
        return value_of(r, field, *first);
      });
    return samples;
  }
  std::optional<Pose> first;
  for (const auto& [stamp, r] : reports_) {
    add(stamp, [&, &r = r] {
      if (!first) first = pose_of(r);
      return value_of(r, field, *first);
    });
  }
  return samples;
}

std::pair<double, double> Readings::extent(const PlotField& field) const {
  constexpr double kEver = std::numeric_limits<double>::infinity();
  std::vector<Sample> all = readings(field, -kEver, kEver);
  std::erase_if(all, [](const Sample& s) { return !std::isfinite(s.y); });
  if (all.empty()) return {std::nan(""), std::nan("")};
  return {all.front().t, all.back().t};
}

std::vector<Sample> ArmReadings::samples(const PlotField& field, double from, double to) const {
  std::vector<Sample> all = readings(field, from, to);
  if (field.source == FieldSource::force && !all.empty() && all.back().t >= biased_at_)
    std::erase_if(all, [this](const Sample& s) { return s.t < biased_at_; });
  return all;
}

}  // namespace mrroc::ui
