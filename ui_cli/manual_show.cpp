#include "ui_cli/manual_show.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <ostream>
#include <span>
#include <vector>

#include "base/command_hint.hpp"
#include "base/joined.hpp"
#include "base/representation.hpp"
#include "ui_cli/fixed_number.hpp"
#include "ui_cli/manual_page.hpp"

namespace mrroc::ui {
namespace {

using Json = nlohmann::ordered_json;
using Numbers = std::vector<double>;

Numbers six(Representation as, const std::optional<Pose>& T) {
  const PoseNumbers numbers = T ? numbers_from_pose(as, *T) : PoseNumbers{};
  return {numbers.begin(), numbers.begin() + 6};
}

/// Shown quantities, in their order.
struct Shown {
  explicit Shown(const EffectorReply& r) : F_a(r.F_a.v.data(), r.F_a.v.data() + 6), known(r.position_known) {
    axes = static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(r.robot_model.set_servo_algorithm)));
    PoseNumbers pose{};
    std::ranges::copy(r.T_0E, pose.begin());
    euler = six(Representation::xyz_euler_zyz, pose_from_numbers(Representation::xyz_angle_axis, pose));
    tool = six(Representation::xyz_angle_axis,
               pose_from_numbers(r.robot_model.tool_representation, r.robot_model.tool));
  }

  /// @return those of the arm's axes; all, as long as nobody knows how many it has
  [[nodiscard]] Numbers of_axes(std::span<const double, kMaxAxes> all) const {
    return {all.begin(),
            all.begin() + static_cast<std::ptrdiff_t>(axes > 0 ? std::min(axes, all.size()) : all.size())};
  }

  Numbers F_a, euler, tool;
  bool known;          ///< where the arm is
  std::size_t axes{};  ///< of the arm; 0: the driver has not told what it works with
};

Json json_of(const Fault& fault) {
  if (!fault) return nullptr;
  return {{"code", to_string(fault.code)},
          {"class", to_string(class_of(fault.code))},
          {"text", what_happened(fault)},
          {"remedy", fault_entry(fault.code).remedy}};
}

Json servo_of(const RobotModel& model, const Shown& s) {
  Json motors = Json::array();
  for (std::size_t k = 0; k < s.axes; ++k)
    motors.push_back(
        {{"algorithm", model.servo_algorithm[k]}, {"parameter_set", model.servo_parameter_set[k]}});
  return motors;
}

Json json_of(const EffectorReply& r, const std::string& arm, const Shown& s) {
  const auto if_known = [](bool known, const auto& value) { return known ? Json(value) : Json(nullptr); };
  const RobotModel& model = r.robot_model;
  const bool told = s.axes > 0;
  return {{"arm", arm},
          {"state", to_string(r.state)},
          {"fault", json_of(r.fault)},
          {"motors", s.of_axes(r.motors)},
          {"joints", if_known(s.known, s.of_axes(r.joints))},
          {"T_0E", if_known(s.known, r.T_0E)},
          {"euler", if_known(s.known, s.euler)},
          {"F_a", s.F_a},
          {"gripper", r.gripper},
          {"blocked", r.blocked},
          {"tool", if_known(told, s.tool)},
          {"weight", if_known(told, model.weight)},
          {"mass_centre", if_known(told, model.mass_centre)},
          {"kinematic_model", if_known(told, model.kinematic_model)},
          {"servo", if_known(told, servo_of(model, s))}};
}

std::string servo_text(const RobotModel& model, std::size_t axes) {
  std::vector<std::string> motors;
  for (std::size_t k = 0; k < axes; ++k)
    motors.push_back(fmt::format("{} {}", model.servo_algorithm[k], model.servo_parameter_set[k]));
  const bool same = std::ranges::all_of(motors, [&](const auto& m) { return m == motors.front(); });
  if (same) motors.resize(std::min<std::size_t>(motors.size(), 1));
  return fmt::format("{}  algorithm and parameter set of {}", joined(motors, ", "),
                     same ? "all motors" : "each motor");
}

}  // namespace

void show_arm(const EffectorReply& r, const std::string& arm, bool json, std::ostream& out) {
  const Shown s(r);
  if (json) {
    out << json_of(r, arm, s).dump(-1, ' ', false, Json::error_handler_t::replace) << "\n";
    return;
  }
  const auto line = [&](const char* name, const std::string& text) {
    out << fmt::format("{:<11} {}\n", name, text);
  };
  const auto row = [&](const char* name, bool known, const auto& numbers, const char* unit) {
    std::string shown = known ? "" : fmt::format("{:>9}", "-");
    if (known)
      for (const double x : numbers) shown += fmt::format("{}{:>9}", shown.empty() ? "" : " ", fixed(x, 4));
    line(name, fmt::format("{}  {}", shown, unit));
  };
  const RobotModel& model = r.robot_model;
  const bool told = s.axes > 0;
  line(arm.c_str(), std::string(to_string(r.state)));
  const bool resets = class_of(r.fault.code) == FaultClass::fatal;
  const std::string then = resets ? fmt::format("; then `ui_cli manual reset {}`", arm) : "";
  line("fault", r.fault ? command_hint(describe(r.fault) + then) : "none");
  row("motors", true, s.of_axes(r.motors), "rad");
  row("joints", s.known, s.of_axes(r.joints), "rad, m");
  row("angle-axis", s.known, r.T_0E, "m, rad");
  row("euler", s.known, s.euler, "m, rad");
  row("force F_a", true, s.F_a, "N, N m in E");
  line("gripper", fmt::format("{:9.4f}  m{}", r.gripper, r.blocked ? ", holds something" : ""));
  row("tool", told, s.tool, "m, rad: E in W");
  row("weight", told, std::vector{model.weight}, "N beyond the sensor");
  row("mass centre", told, model.mass_centre, "m in W");
  line("model", told ? fmt::format("{}  of the kinematics", model.kinematic_model) : "-");
  line("servo", told ? servo_text(model, s.axes) : "-");
}

}  // namespace mrroc::ui
