#include "sim/platform/motion_capture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc::sim {

MotionCaptureSystem::MotionCaptureSystem(const MotionCaptureParameters& parameters, std::uint64_t seed,
                                         double dt)
    : k_(parameters), dt_(dt), random_(seed) {}

std::optional<CapturedPose> MotionCaptureSystem::step(std::int64_t step, const PlanarPose& pose) {
  if (step % k_.setup.period == 0) under_way_.push_back({step / k_.setup.period, measure(step, pose)});
  if (under_way_.empty() || under_way_.front().reading.step + k_.setup.latency > step) return {};
  const CapturedPose visible = under_way_.front();
  under_way_.pop_front();
  return visible;
}

MotionCapture MotionCaptureSystem::measure(std::int64_t step, const PlanarPose& pose) {
  const double time = static_cast<double>(step) * dt_;
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const double x = k_.noise[0] * normal(random_), y = k_.noise[0] * normal(random_);
  const double turn = k_.noise[1] * normal(random_);
  const bool outlier = uniform(random_) < k_.outliers;
  const double direction = 2 * std::numbers::pi * uniform(random_);
  MotionCapture m{step, !contains(k_.lost, time), {}};
  if (!m.seen) return m;
  const PlanarPose offset = contains(k_.displaced, time) ? k_.offset : PlanarPose{};
  const double wrong = outlier ? k_.outlier[0] : 0;
  m.p.x = pose.x + offset.x + x + wrong * std::cos(direction);
  m.p.y = pose.y + offset.y + y + wrong * std::sin(direction);
  m.p.phi = wrap_angle(pose.phi + offset.phi + turn + (outlier ? k_.outlier[1] : 0));
  return m;
}

}  // namespace mrroc::sim
