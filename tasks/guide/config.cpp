#include "tasks/guide/config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/representation.hpp"
#include "ecp/preparation.hpp"

namespace mrroc::guide {
namespace {

using std::numbers::pi;

enum class Shape : std::uint8_t { line, plane, circle, curve };

constexpr double kClosing = 1e-5;             // ends of a drawn curve so near one another are one [m]
constexpr double kFullTurn = 360;             // [deg]
constexpr std::size_t kMostNumbers = 20'000;  // of a drawn curve

[[noreturn]] void refuse(const std::string& wrong, const std::string& remedy = {}) {
  throw FaultError(FaultCode::bad_configuration, wrong, remedy);
}

Curve arc(double radius, double degrees) {
  const bool closed = degrees >= kFullTurn;
  const int pieces = 1440;
  Points points;
  for (int k = 0; k < pieces + (closed ? 0 : 1); ++k) {
    const double angle = degrees * pi / 180 * k / pieces;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return Curve(points, closed, 0);
}

Curve drawn(const std::vector<double>& numbers, double rounding) {
  if (numbers.size() < 4 || numbers.size() % 2 != 0 || numbers.size() > kMostNumbers)
    refuse(fmt::format("task.curve: {} numbers are no curve", numbers.size()),
           "give x and y of 2 to 10000 points [mm], or an SVG file with --fixture");
  Points points;
  for (std::size_t k = 0; k < numbers.size(); k += 2)
    points.emplace_back(1e-3 * Point(numbers[k], numbers[k + 1]));
  const bool closed = points.size() > 3 && (points.front() - points.back()).norm() < kClosing;
  if (closed) points.pop_back();
  try {
    return Curve(points, closed, rounding);
  } catch (const SharpCorner& e) {
    refuse(
        fmt::format(
            "task.curve turns too sharply at ({:.1f}, {:.1f}) mm: the nearest place would not be one place",
            1e3 * e.where().x(), 1e3 * e.where().y()),
        fmt::format("make task.corner larger than {:g} m, or draw the corner wider", rounding));
  } catch (const std::invalid_argument&) {
    refuse(fmt::format("task.curve is shorter than {:g} mm", 1e3 * Curve::kLeastLength),
           "draw it larger, or give a --size");
  }
}

Pose read_place(const Config& task) {
  const auto p = task.numbers<3>("centre", std::array{0.9, 0., 0.99}, {-2, 2}, "m");
  const auto turned = task.numbers<3>("turned", std::array{0., 0., -pi / 2}, {-pi, pi}, "rad");
  return {rotation_from_angle_axis({turned[0], turned[1], turned[2]}), {p[0], p[1], p[2]}};
}

Fixture read_fixture(const Config& task) {
  const Pose T_0F = read_place(task);
  const auto shape = task.choice(
      "fixture", Shape::line,
      {{"line", Shape::line}, {"plane", Shape::plane}, {"circle", Shape::circle}, {"curve", Shape::curve}});
  const double length = task.number("length", 0.12, {0.02, 0.4}, "m");
  const double width = task.number("width", 0.08, {0.02, 0.4}, "m");
  const double radius = task.number("radius", 0.04, {0.005, 0.2}, "m");
  const double degrees = task.number("arc", kFullTurn, {10, kFullTurn}, "deg");
  const double rounding = task.number("corner", 0.003, {0, 0.02}, "m");
  const auto numbers = task.list("curve", std::vector<double>{}, {-200, 200}, "mm");
  switch (shape) {
    case Shape::plane:
      return {T_0F, std::array{length, width}};
    case Shape::circle:
      return {T_0F, arc(radius, degrees)};
    case Shape::curve:
      return {T_0F, drawn(numbers, rounding)};
    case Shape::line:
      break;
  }
  return {T_0F, Curve({{-length / 2, 0}, {length / 2, 0}}, false, 0)};
}

Law read_law(const Config& task) {
  Law k;
  k.stiffness = task.number("stiffness", k.stiffness, {1000, 50'000}, "N/m");
  k.mobility = task.number("mobility", k.mobility, {1e-4, 0.02}, "s/kg");
  k.inertia = task.number("inertia", k.inertia, {0.5, 20}, "kg");
  k.free_mobility = task.number("free_mobility", k.free_mobility, {0.002, 0.05}, "s/kg");
  k.free_inertia = task.number("free_inertia", k.free_inertia, {0.5, 20}, "kg");
  k.bend = task.number("bend", k.bend, {0, 0.1}, "m");
  k.wall_stiffness = task.number("wall_stiffness", k.wall_stiffness, {500, 50'000}, "N/m");
  k.wall_softness = task.number("wall_softness", k.wall_softness, {0.0005, 0.01}, "m");
  k.most_force = task.number("most_force", k.most_force, {20, 60}, "N");
  if (k.mobility > k.free_mobility)
    refuse(fmt::format(
               "task.mobility {:g} is above task.free_mobility {:g}: across the fixture the tool would go "
               "more easily than along it",
               k.mobility, k.free_mobility),
           "make task.mobility smaller");
  if (return_rate(k) > kMostReturnRate)
    refuse(
        fmt::format("stiffness times mobility is {:.0f} 1/s, and from {:.0f} on a fixture may swing: what is "
                    "measured moves the arm some {:.0f} ms later",
                    return_rate(k), kMostReturnRate, 3e3 * kPacing.macrostep_s() / 2),
        fmt::format("make task.mobility {:.2g} or less, or the stiffness smaller",
                    kMostReturnRate / std::max(k.stiffness, k.wall_stiffness)));
  return k;
}

}  // namespace

std::shared_ptr<const Setup> read_setup(const Config& config, const std::string& arm) {
  const Config task = config.section("task");
  auto k = std::make_shared<Setup>();
  k->fixture = read_fixture(task);
  k->law = read_law(task);
  k->capture = task.number("capture", k->capture, {0.0005, 0.05}, "m");
  k->entry = task.number("entry", k->entry, {0.2, 10}, "s");
  k->leave = task.number("leave", k->leave, {0.2, 10}, "s");
  k->entry_speed = task.number("entry_speed", k->entry_speed, {0.005, 0.1}, "m/s");
  const RobotModel model = ecp::read_tool_model(config, arm);
  k->T_WE = pose_from_numbers(model.tool_representation, model.tool).value_or(Pose{});
  return k;
}

OperatorPlan read_operator(const Config& config, const Law& law, double compliance) {
  const Config t = config.section("operator");
  OperatorPlan k;
  k.learnt.stiffness =
      t.number("stiffness", law.stiffness, {1000, 50'000}, "N/m, that he expects of the fixture");
  k.learnt.wall_stiffness =
      t.number("wall_stiffness", law.wall_stiffness, {500, 50'000}, "N/m, that he expects of its ends");
  k.learnt.wall_softness =
      t.number("wall_softness", law.wall_softness, {0.0005, 0.01}, "m, that he expects of its ends");
  k.speed = t.number("speed", k.speed, {0.005, 0.1}, "m/s");
  k.acceleration = t.number("acceleration", k.acceleration, {0.02, 1}, "m/s^2");
  k.push = t.number("push", k.push, {0, 40}, "N");
  k.turn = t.number("turn", k.turn, {0.5, 30}, "s");
  k.wall_push = t.number("wall_push", k.wall_push, {0, 40}, "N");
  k.start = t.number("start", k.start, {0, 0.06}, "m");
  k.compliance = compliance;
  return k;
}

}  // namespace mrroc::guide
