#include "tasks/rubik/plan/paths.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::rubik {
namespace {

constexpr double kSpacing = 0.01;  // of the states that are checked, as the way of the farthest point [m]
// Lever arms of the joints, counted from the last one [m].
constexpr std::array<double, 7> kLevers{0.1, 0.4, 0.4, 1.0, 1.4, 1.4, 1.0};
constexpr int kRandomPoints = 150;
constexpr double kWide = 0.7;  // standard deviation of random points [rad]; on the track: as metres of it
constexpr double kTrackWide = 0.2;

double length(const AxisVector& way) {
  double metres = 0;
  for (Eigen::Index k = 0; k < way.size(); ++k)
    metres = std::max(metres, std::abs(way[k]) * kLevers[static_cast<std::size_t>(way.size() - 1 - k)]);
  return metres;
}

}  // namespace

double seconds_along(const std::vector<AxisVector>& points, const JointLimits& limits) {
  double seconds = 0;
  bool moves = false;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double part = (points[k] - points[k - 1]).cwiseAbs().cwiseQuotient(limits.velocity).maxCoeff();
    seconds += part;
    moves = moves || part > 0;
  }
  return moves ? seconds + limits.velocity.cwiseQuotient(limits.acceleration).maxCoeff() : 0;
}

bool Paths::is_free(Hand hand, const AxisVector& from, const AxisVector& to, CellState state) const {
  const AxisVector way = to - from;
  const int parts = std::max(1, static_cast<int>(std::ceil(length(way) / kSpacing)));
  // The middle first: what collides there is found soonest.
  const auto free_at = [&](int k) {
    AxisVector& joints = state.joints[index(hand)];
    joints = from + way * (static_cast<double>(k) / parts);
    return cell_.reserve(hand, joints) > 0 && cell_.is_free(state);
  };
  for (int stride = 8; stride >= 1; stride /= 2)
    for (int k = 0; k <= parts; k += stride)
      if ((stride == 8 || k % (2 * stride) != 0) && !free_at(k)) return false;
  return free_at(parts);
}

bool Paths::is_free(Hand hand, const std::vector<AxisVector>& points, const CellState& state) const {
  for (std::size_t k = 1; k < points.size(); ++k)
    if (!is_free(hand, points[k - 1], points[k], state)) return false;
  return true;
}

std::optional<AxisVector> Paths::drawn_back(Hand hand, const AxisVector& joints, double distance) const {
  const auto back =
      cell_.inverse(hand, cell_.forward(hand, joints) * Pose{Matrix3::Identity(), {0, 0, -distance}}, joints);
  if (!back || cell_.reserve(hand, *back) <= 0) return {};
  return back;
}

std::optional<std::vector<AxisVector>> Paths::find(Hand hand, const AxisVector& from, const AxisVector& to,
                                                   const CellState& state) const {
  if (is_free(hand, from, to, state)) return std::vector{from, to};

  std::optional<std::vector<AxisVector>> best;
  double seconds = 1e9;
  const auto consider = [&](const std::vector<AxisVector>& points) {
    const double s = seconds_along(points, cell_.limits(hand));
    if (s >= seconds || !is_free(hand, points, state)) return;
    best = points;
    seconds = s;
  };
  const std::array distances{0.0, 0.1, 0.2, 0.3};
  for (const double first : distances)
    for (const double last : distances) {
      std::vector<AxisVector> points{from};
      if (const auto p = drawn_back(hand, from, first); p && first > 0) points.push_back(*p);
      if (const auto p = drawn_back(hand, to, last); p && last > 0) points.push_back(*p);
      points.push_back(to);
      consider(points);
    }
  if (best) return best;

  std::mt19937_64 random(1);
  const auto uniform = [&] { return 2 * static_cast<double>(random() >> 11) * 0x1p-53 - 1; };
  for (int k = 0; k < kRandomPoints; ++k) {
    AxisVector via = (from + to) / 2;
    for (Eigen::Index j = 0; j < via.size(); ++j)
      via[j] += (via.size() > 6 && j == 0 ? kTrackWide : kWide) * (uniform() + uniform());
    if (cell_.reserve(hand, via) > 0) consider({from, via, to});
  }
  return best;
}

}  // namespace mrroc::rubik
