#include "tasks/rex_drive/still_pictures.hpp"

#include <cmath>

namespace mrroc::rex_drive {
namespace {

constexpr double kStill = 1e-3;   // way [m] and turn [rad] that a pair of a camera that hangs may show
constexpr double kStands = 3;     // times as much in all: from there on a platform creeps
constexpr double kTurned = 0.06;  // mean of the wheels: from there on something must be seen to move [rad]

bool within(double times, double x, double y, double turn) {
  return std::hypot(x, y) < times * kStill && std::abs(turn) < times * kStill;
}

double turned_since(const PerWheel& before, const PerWheel& now) {
  double sum = 0;
  for (std::size_t k = 0; k < now.size(); ++k) sum += std::abs(now[k] - before[k]);
  return sum / static_cast<double>(now.size());
}

}  // namespace

StillPictures seen(StillPictures still, const OdometryReading& reading, const WheelWatch& watch) {
  if (!reading.valid || reading.step <= still.step) return still;
  const auto& A = reading.A;
  const double x = A[3], y = A[7], turn = std::atan2(A[4], A[0]);
  still.step = reading.step;
  if (!within(1, x, y, turn)) return {.step = reading.step};
  if (!still.theta || !within(kStands, still.x + x, still.y + y, still.turn + turn))
    still = {.step = reading.step, .theta = angles_at(watch, reading.step_before)};
  still.x += x;
  still.y += y;
  still.turn += turn;
  const auto now = angles_at(watch, reading.step);
  if (still.theta && now) still.against_wheels = turned_since(*still.theta, *now) > kTurned;
  return still;
}

}  // namespace mrroc::rex_drive
