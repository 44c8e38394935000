#include "tasks/box_push/observation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mrroc::box_push {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// @return differences from the first reading: small ones, also where phi passes from pi to -pi
std::vector<PlanarPose> from_first(const std::vector<PlanarPose>& readings) {
  const PlanarPose& first = readings.front();
  std::vector<PlanarPose> all;
  for (const PlanarPose& p : readings)
    all.push_back({p.x - first.x, p.y - first.y, wrap_angle(p.phi - first.phi)});
  return all;
}

PlanarPose medians(const std::vector<PlanarPose>& poses) {
  std::vector<double> x, y, phi;
  for (const PlanarPose& p : poses) {
    x.push_back(p.x);
    y.push_back(p.y);
    phi.push_back(p.phi);
  }
  return {median(std::move(x)), median(std::move(y)), median(std::move(phi))};
}

}  // namespace

PlanarPose pose_of(const std::vector<PlanarPose>& readings) {
  const std::vector<PlanarPose> all = from_first(readings);
  const PlanarPose middle = medians(all);
  PlanarPose sum;
  double n = 0;
  for (const PlanarPose& p : all) {
    if (std::abs(p.x - middle.x) > kAgrees || std::abs(p.y - middle.y) > kAgrees ||
        std::abs(p.phi - middle.phi) > kTurnedAgrees)
      continue;
    sum.x += p.x;
    sum.y += p.y;
    sum.phi += p.phi;
    ++n;
  }
  if (n == 0) sum = middle, n = 1;
  const PlanarPose& first = readings.front();
  return {first.x + sum.x / n, first.y + sum.y / n, wrap_angle(first.phi + sum.phi / n)};
}

}  // namespace mrroc::box_push
