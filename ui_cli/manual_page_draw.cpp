// Draws the page of manual operation.
#include <fmt/core.h>

#include <algorithm>
#include <bit>

#include "base/command_hint.hpp"
#include "base/fault.hpp"
#include "ui_cli/layout_tables.hpp"
#include "ui_cli/manual_page.hpp"
#include "ui_cli/manual_steps.hpp"

namespace mrroc::ui {
namespace {

constexpr int kName = 12;  // first column of the first arm
constexpr int kArm = 32;   // columns of an arm

Style style_of(DriverState s) {
  return s == DriverState::faulted            ? Style::bad
         : s == DriverState::not_synchronised ? Style::warning
                                              : Style::good;
}

std::string_view unit_name(bool motors_or_angles) { return motors_or_angles ? "rad" : "m"; }

/// Kinematic model, and algorithm and parameter set of the servo, as the driver works with them.
std::string model_text(const RobotModel& model) {
  if (model.set_servo_algorithm == 0) return "-";
  const auto motors =
      static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(model.set_servo_algorithm)));
  bool same = true;
  for (std::size_t k = 1; k < std::min(motors, model.servo_algorithm.size()); ++k)
    same = same && model.servo_algorithm[k] == model.servo_algorithm[0] &&
           model.servo_parameter_set[k] == model.servo_parameter_set[0];
  const std::string servo = fmt::format("{} {}", model.servo_algorithm[0], model.servo_parameter_set[0]);
  return fmt::format("{}  servo {}", model.kinematic_model, same ? servo : "differs");
}

/// @return the first column of an arm
int column_of(std::size_t arm) { return kName + static_cast<int>(arm) * kArm; }

void draw_arm_states(Canvas& c, int row, const std::vector<ManualArm>& arms) {
  for (std::size_t k = 0; k < arms.size(); ++k) {
    const auto& r = arms[k].reading;
    const int column = c.put(row, column_of(k), arms[k].name, Style::heading);
    c.put(row, column + 2, r ? to_string(r->state) : "not heard yet",
          r ? style_of(r->state) : Style::warning);
  }
}

/// Three numbers of the force and torque. @param first  number of the first of them
std::string wrench_text(const EffectorReply& r, std::size_t first) {
  const auto& v = r.F_a.v;
  return fmt::format("{:>7} {:>7} {:>7}", fixed(v[first], 2), fixed(v[first + 1], 2), fixed(v[first + 2], 2));
}

/// What the arms feel and hold, what is wrong with them, and what they work with.
void draw_arm_readings(Rows& rows, const std::vector<ManualArm>& arms) {
  const auto line = [&](const char* name, auto&& text) {
    if (rows.left() == 0) return;
    const int row = rows.take();
    rows.canvas().put(row, 3, name, Style::dim);
    for (std::size_t k = 0; k < arms.size(); ++k)
      if (const auto& r = arms[k].reading) rows.canvas().put(row, column_of(k), text(*r).substr(0, kArm - 1));
  };
  line("F [N]", [](const EffectorReply& r) { return wrench_text(r, 0); });
  line("N [N m]", [](const EffectorReply& r) { return wrench_text(r, 3); });
  line("jaws [m]", [](const EffectorReply& r) {
    return fmt::format("{:>7}{}", fixed(r.gripper, 4), r.blocked ? "  holds something" : "");
  });
  line("fault",
       [](const EffectorReply& r) { return r.fault ? std::string(mrroc::to_string(r.fault.code)) : "none"; });
  line("model", [](const EffectorReply& r) { return model_text(r.robot_model); });
}

}  // namespace

void ManualPage::draw(Canvas& c, int first, int limit) const {
  Rows rows(c, first, limit);
  if (arms_.empty()) {
    c.put(rows.take(), 1, "the arms of this task are not known here: its config.toml cannot be read",
          Style::warning);
    return;
  }
  const int column = c.put(rows.take(), 1, "MANUAL ", Style::heading);
  draw_choices(c, first, column);
  c.put(rows.take(), 1,
        fmt::format("step {} {}   speed {} of the largest   {}", step(), unit_name(unit() != Unit::length),
                    kSpeeds[speed_], space_ >= Space::euler ? "steps along the tool" : "steps of one axis"),
        Style::dim);
  draw_arm_states(c, rows.take(), arms_);
  draw_coordinates(rows);
  if (rows.left() > 5) rows.skip(1);
  draw_arm_readings(rows, arms_);
}

void ManualPage::draw_choices(Canvas& c, int row, int column) const {
  for (std::size_t k = 0; k <= arms_.size(); ++k) {
    const bool every = k == arms_.size(), chosen = every ? all_ : !all_ && k == arm_;
    column = c.put(row, column + 1, fmt::format(" {} {} ", every ? 0 : k + 1, every ? "all" : arms_[k].name),
                   chosen ? Style::title : Style::plain);
  }
  column += 2;
  for (std::size_t k = 0; k < 4; ++k) {
    constexpr std::array<std::string_view, 4> kShort{"motors", "joints", "euler", "angle-axis"};
    column = c.put(row, column + 1, fmt::format(" {} ", kShort[k]),
                   k == static_cast<std::size_t>(space_) ? Style::title : Style::plain);
  }
}

void ManualPage::draw_coordinates(Rows& rows) const {
  int most = coordinates();
  if (space_ < Space::euler)
    for (const ManualArm& a : arms_) most = std::max(most, a.axes);
  const int from =
      rows.left() < most ? std::clamp(axis_ - rows.left() / 2, 0, most - std::max(1, rows.left())) : 0;
  for (int axis = from; axis < most && rows.left() > 0; ++axis)
    draw_coordinate(rows.canvas(), rows.take(), axis);
}

void ManualPage::draw_coordinate(Canvas& c, int row, int axis) const {
  const bool pose = space_ >= Space::euler;
  const bool chosen = axis == axis_;
  c.put(row, 1, fmt::format("{} {}", chosen ? ">" : " ", coordinate_name(pose, axis)),
        chosen ? Style::heading : Style::plain);
  for (std::size_t k = 0; k < arms_.size(); ++k) {
    if (!arms_[k].reading || (!pose && axis >= arms_[k].axes)) continue;
    const bool mine = chosen && !all_ && k == arm_;
    const bool track = space_ == Space::joints && arms_[k].axes > 6 && axis == 0;
    const bool length = track || (pose && axis < 3);
    const auto at = static_cast<std::size_t>(axis);
    const bool known = space_ == Space::motors || arms_[k].reading->position_known;
    c.put_right(row, column_of(k) + 11, known ? fixed(values(arms_[k])[at], 4) : "-",
                mine ? Style::title : Style::plain);
    c.put(row, column_of(k) + 12, unit_name(!length), Style::dim);
  }
}

void ManualPage::draw_help(Rows& rows) {
  constexpr std::array<std::string_view, 11> kHelp{
      "1 2  0       the arm; all arms",
      "arrows       up, down: the coordinate; left, right: jog it",
      "c  + -  < >  coordinates; the step; the speed",
      "a            to an absolute coordinate: type it, Enter",
      "h  b  z      home, bias the force, clear the fault; Enter",
      "o  g  w  W   preset, jaws, tool, weight: type what it needs",
      "k  v         kinematic model, servo algorithm: the same",
      "blank        stops what the arm does",
      ":            any words of `ui_cli manual --help`",
      "m or Escape  back to the task; e x p r ? q as there",
      "Any key goes back."};
  for (const std::string_view line : kHelp) rows.canvas().put(rows.take(), 1, command_hint(line));
}

void ManualPage::draw_keys(Canvas& c, int first) const {
  constexpr std::array<std::string_view, kKeyRows> kKeys{
      "1 2 arm 0 all  arrows axis, jog  c coordinates  a absolute  + - step  < > speed",
      "h home o preset g jaws w tool W weight k model v servo b bias z clear : words",
      "e E-STOP  ? help  space stop arm  m back  x stop task  p pause r resume  q leave"};
  if (typing()) {
    c.put(first + kKeyRows - 1, 0, "Ctrl-E E-STOP  Enter sends  Escape drops the line", Style::heading);
    return;
  }
  for (std::size_t k = 0; k < kKeys.size(); ++k)
    c.put(first + static_cast<int>(k), 0, kKeys[k], Style::heading);
}

}  // namespace mrroc::ui
