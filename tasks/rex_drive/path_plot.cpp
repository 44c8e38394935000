#include "tasks/rex_drive/path_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/gnuplot_text.hpp"
#include "base/room_plot.hpp"

namespace mrroc::rex_drive {
namespace {

constexpr const char* kEllipseColour = "#e8a374";
constexpr double kLarger = 10;  // ellipses are drawn so many times as large

/// The 95 % ellipse of an estimate. @return lines of a data block
std::string ellipse(const PlatformEstimate& e) {
  constexpr double kRadius = 2.4477;  // of 95 % in a plane
  constexpr int kCorners = 24;
  const double a = e.covariance[0], b = e.covariance[1], d = e.covariance[4];
  if (!(a > 0) || !(a * d > b * b)) return {};
  const double l11 = std::sqrt(a), l21 = b / l11, l22 = std::sqrt(d - l21 * l21);
  std::string data;
  for (int corner = 0; corner <= kCorners; ++corner) {
    const double s = 2 * std::numbers::pi * corner / kCorners;
    const double u = kLarger * kRadius * std::cos(s), w = kLarger * kRadius * std::sin(s);
    data += fmt::format("{:.4f},{:.4f}\n", e.p.x + l11 * u, e.p.y + l21 * u + l22 * w);
  }
  return data + "\n";
}

/// Few ellipses, and none while the platform stands: they would hide the way.
std::string ellipses(const DriveTable& table) {
  constexpr double kApart = 2;  // [s]
  std::string data = "$ellipses << EOD\n";
  double last = -kApart;
  for (const DriveRow& row : table) {
    if (row.executing == 0 || row.t < last + kApart) continue;
    data += ellipse(row.estimate);
    last = row.t;
  }
  return data + "NaN,NaN\nEOD\n";
}

std::string plan_points(const std::vector<Plan>& plans) {
  std::string data = "$plan << EOD\n";
  for (const Plan& plan : plans)
    for (std::int32_t k = 0; k < plan.n; ++k) {
      const auto& [px, py] = plan.point[static_cast<std::size_t>(k)];
      data += fmt::format("{:.4f},{:.4f}\n", px, py);
    }
  return data + "NaN,NaN\nEOD\n";
}

/// The colour of a floor with that friction: the more slippery, the more like ice. @param opacity  0..1
std::string floor_colour(double friction, double opacity) {
  constexpr double kRough = 0.8;
  const double ice = std::clamp(1 - friction / kRough, 0.0, 1.0);
  const auto part = [ice](int rough, int slippery) {
    return static_cast<int>(std::lround(std::lerp(rough, slippery, ice)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}{:02x}", static_cast<int>(std::lround(255 * (1 - opacity))),
                     part(0xf6, 0x6f), part(0xf1, 0xb4), part(0xe7, 0xe8));
}

/// Something of the floor that has one friction, with its entry in the key.
struct Floor {
  RoomPoint lower, upper;
  double scale;
  std::string name;
  double opacity;
};

std::vector<Floor> floors(const DriveResults& r) {
  std::vector<Floor> all{{r.room.lower, r.room.upper, 1, "floor", 1}};
  for (const GroundArea& area : r.ground.areas) {
    constexpr double kOverOthers = 0.75;
    const std::string since = area.from > 0 ? fmt::format(" from {:g} s on", area.from) : "";
    const RoomPoint lower{std::max(area.lower[0], r.room.lower[0]), std::max(area.lower[1], r.room.lower[1])};
    const RoomPoint upper{std::min(area.upper[0], r.room.upper[0]), std::min(area.upper[1], r.room.upper[1])};
    if (lower[0] < upper[0] && lower[1] < upper[1])
      all.push_back(
          {lower, upper, area.scale, fmt::format("area x {:.3g}{}", area.scale, since), kOverOthers});
  }
  return all;
}

std::string colour_of(const Floor& floor, const DriveGround& ground) {
  return floor_colour(floor.scale * (ground.friction[0] + ground.friction[1]) / 2, floor.opacity);
}

std::string ground(const DriveResults& r) {
  std::string s;
  for (const Floor& floor : floors(r))
    s += plot_rectangle(
        floor.lower, floor.upper,
        fmt::format("fillcolor rgb '{}' fillstyle solid 1 noborder", colour_of(floor, r.ground)));
  return s;
}

/// Entries of the key: areas of one name have one.
std::string ground_key(const DriveResults& r) {
  std::string s;
  std::set<std::string> named;
  for (const Floor& floor : floors(r))
    if (named.insert(floor.name).second)
      s += fmt::format(
          "keyentry with boxes fillstyle solid 1 border lc rgb '{}' fillcolor rgb '{}' title '{}: friction "
          "{:.3g} "
          "along, {:.3g} across', \\\n  ",
          kWallColour, colour_of(floor, r.ground), floor.name, floor.scale * r.ground.friction[0],
          floor.scale * r.ground.friction[1]);
  return s;
}

/// Where the platform stood at the beginning, and which way it looked.
std::string start(const PlanarPose& p) {
  constexpr double kLength = 0.25;  // [m]
  return fmt::format(
      "set arrow from {:.4f},{:.4f} to {:.4f},{:.4f} head filled size 0.08,20 lw 2 lc rgb '{}' front\n", p.x,
      p.y, p.x + kLength * std::cos(p.phi), p.y + kLength * std::sin(p.phi), kReferenceColour);
}

std::string way(int column, double width, std::string_view colour, const char* title) {
  return fmt::format("'platform.csv' skip 1 using {}:{} with lines lw {} lc rgb '{}' title '{}', \\\n  ",
                     column, column + 1, width, colour, title);
}

}  // namespace

std::string path_script(const DriveResults& r) {
  std::string s = gnuplot_head("plots/path.png", 1200, 900);
  s += ellipses(r.table) + plan_points(r.plans);
  s += "set title 'Rex: the way, seen from above' font 'sans:Bold,14' textcolor rgb '#1b2a41'\n"
       "set size ratio -1\nset xlabel 'x [m]'\nset ylabel 'y [m]'\nset key below height 1.5\n";
  s += ground(r) + plot_room(r.room);
  if (!r.table.empty()) s += start(r.table.front().truth.p);
  s += "plot " + ground_key(r) + way(column::x_d, 5, kObstacleColour, "reference");
  s += fmt::format(
      "$ellipses using 1:2 with lines lw 0.7 lc rgb '{}' title '95 % ellipse, times {:g}', \\\n  ",
      kEllipseColour, kLarger);
  s += way(column::x, 1.6, curve_colour(0), "true") + way(column::x_e, 1, curve_colour(1), "estimate");
  s += fmt::format("$plan using 1:2 with points pt 7 ps 0.9 lc rgb '{}' title 'plan'\n", kReferenceColour);
  return s;
}

}  // namespace mrroc::rex_drive
