#include "tasks/guide/figures.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mrroc::guide {
namespace {

constexpr double kMoving = 0.005;   // from this speed on the tool is led along [m/s]
constexpr double kInWall = 0.0005;  // so deep in a wall its force is not that of the way [m]

bool in_wall(const Standing& s) { return std::max(std::abs(s.beyond[0]), std::abs(s.beyond[1])) > 0; }

bool deep(const Standing& s) { return std::hypot(s.beyond[0], s.beyond[1]) > kInWall; }

/// Sums over a run.
struct Sums {
  double deviation{}, across{}, wall{}, depth{}, step{};
  double work{}, way{};     // along the fixture, off its walls [J], [m]
  double taken{}, least{};  // energy that the hand has given since the tool is guided, and its smallest [J]
  double off_force{}, force_force{};  // of a line through the origin, off = compliance * force
  int rows{}, walls{};
};

void add_guided(Sums& s, const LedRow& row, double dt) {
  ++s.rows;
  s.taken -= dt * row.F.dot(row.velocity);
  s.least = std::min(s.least, s.taken);
  s.deviation = std::max(s.deviation, row.standing.off());
  s.across = std::max(s.across, row.across);
  s.off_force += row.standing.off() * row.across;
  s.force_force += row.across * row.across;
  if (in_wall(row.standing)) {
    ++s.walls;
    s.wall = std::max(s.wall, row.along);
    s.depth = std::max(s.depth, std::hypot(row.standing.beyond[0], row.standing.beyond[1]));
  }
}

Sums sums_of(const std::vector<LedRow>& rows, const Fixture& fixture) {
  Sums s;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const LedRow& row = rows[k];
    const double dt = row.t - rows[k - 1].t;
    if (row.m != kGuided) {
      s.step = std::max(s.step, dt * row.velocity.norm() / kPacing.n_s);
      continue;
    }
    add_guided(s, row, dt);
    if (std::abs(row.speed) < kMoving || deep(row.standing)) continue;
    const Vector3 normal = fixture.axes(row.standing.s).col(2);
    const Vector3 free = fixture.is_plane() ? Vector3(row.velocity - normal * normal.dot(row.velocity))
                                            : Vector3(fixture.axes(row.standing.s).col(0) * row.speed);
    s.work -= dt * row.F.dot(free);
    s.way += dt * free.norm();
  }
  return s;
}

}  // namespace

std::vector<LedRow> led_rows(const mp::ArmTrace& trace, const Setup& k) {
  std::vector<LedRow> rows;
  std::optional<double> s;
  std::optional<Vector3> before;
  double t = 0;
  for (const mp::ArmRow& row : trace) {
    if (row.m < kEnter || row.m > kLeave) continue;
    const Pose T_0E = pose_from_angle_axis(row.pose);
    LedRow led{.t = row.t, .m = row.m, .standing = k.fixture.stand(T_0E.p, s)};
    s = led.standing.s;
    const Matrix3 R = k.fixture.axes(*s);
    if (before) led.velocity = (T_0E.p - *before) / (row.t - t);
    led.F = T_0E.R * row.F.linear();
    const Vector3 F = R.transpose() * led.F, v = R.transpose() * led.velocity;
    const bool plane = k.fixture.is_plane();
    led.along = plane ? std::max(std::abs(F.x()), std::abs(F.y())) : std::abs(F.x());
    led.across = plane ? std::abs(F.z()) : std::hypot(F.y(), F.z());
    led.speed = plane ? std::hypot(v.x(), v.y()) : v.x();
    before = T_0E.p;
    t = row.t;
    rows.push_back(led);
  }
  return rows;
}

mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config& config) {
  const auto k = read_setup(config, "arm1");
  const Sums s = sums_of(led_rows(arms[0], *k), k->fixture);
  const auto measured = [&](double value) { return s.rows > 0 ? value : NAN; };
  return {
      {{.key = "fixture_dev_mm", .words = "off the fixture, largest", .unit = "mm", .high = 1},
       measured(1e3 * s.deviation)},
      {{"across_force_N", "  force across it, largest", "N"}, measured(s.across)},
      {{"compliance_mm_per_10N", "  off it per 10 N across", "mm"},
       measured(s.force_force > 0 ? 1e4 * s.off_force / s.force_force : NAN)},
      {{.key = "fixture_drag_N", .words = "force needed along it", .unit = "N", .high = 2},
       measured(s.way > 0 ? s.work / s.way : NAN)},
      {{"wall_force_N", "force of its walls, largest", "N"}, s.walls > 0 ? s.wall : measured(0)},
      {{"wall_depth_mm", "  depth in them, largest", "mm"}, measured(1e3 * s.depth)},
      {{.key = "entry_step_mm",
        .words = "motion in a step while it takes hold or lets go, largest",
        .unit = "mm",
        .high = 0.15},
       measured(1e3 * s.step)},
      {{.key = "least_energy_mJ", .words = "energy that the hand has given, least", .unit = "mJ", .low = -1},
       measured(1e3 * s.least)}};
}

}  // namespace mrroc::guide
