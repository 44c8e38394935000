#include "robots/rex/ekf.hpp"

#include <algorithm>
#include <utility>

#include "robots/rex/estimate.hpp"

namespace mrroc::rex {

void Ekf::begin(const edp::StandingStill& found) noexcept {
  window_.begin(found);
  before(0) = standing_belief(found, window_);
  changed_ = 0;
  inconsistent_ = false;
  displacement_ = {};
  filter();
}

void Ekf::add(const edp::StageReading& reading) noexcept {
  filter();
  const bool shifts = window_.full();
  switch (window_.add(reading)) {
    case Entry::repeated:
      return;
    case Entry::restart:
      before(0) = newest_;
      break;
    case Entry::next:
      if (shifts) std::move(before_.begin() + 1, before_.end(), before_.begin());
      go_on(window_.size() - 2);
  }
  changed_ = window_.size() - 1;
}

bool Ekf::add(const OdometryReading& odometry) noexcept {
  const int picture = window_.add(odometry);
  if (picture < 0) return false;
  if (picture < changed_) window_.see_heading(picture, before(picture).z[2]);
  changed_ = std::min(changed_, picture);
  return true;
}

bool Ekf::add(const MapPose& pose) noexcept {
  filter();
  const int k = window_.add(pose);
  if (k < 0) return false;
  const Eigen::Matrix3d covariance = pose_covariance(before(k), window_.centre());
  changed_ = std::min(changed_, k);
  inconsistent_ = inconsistent_ || beyond_ellipse(window_[k], before(k).z, covariance, window_.centre());
  if (const auto displacement = displacement_at(window_, k, before(k).z, covariance)) displace(*displacement);
  return true;
}

void Ekf::displace(const Displacement& displacement) noexcept {
  window_.displace(displacement.motion.phi);
  for (int i = 0; i < window_.size(); ++i) before(i) = moved(before(i), displacement);
  newest_ = moved(newest_, displacement);
  displacement_ = chained(displacement.motion, displacement_);
  changed_ = 0;
}

edp::EstimatorResult Ekf::step() noexcept {
  if (window_.size() == 0) return no_result();
  filter();
  const edp::Health health{.ok = true, .inconsistent = std::exchange(inconsistent_, false), .iterations = 1};
  edp::EstimatorResult result = result_of(newest_, window_, health);
  result.displacement = std::exchange(displacement_, {});
  return result;
}

void Ekf::filter() noexcept {
  for (; changed_ < window_.size(); ++changed_) {
    newest_ = before(changed_);
    correct(newest_, window_.residuals_at(changed_, newest_.z), newest_.z);
    if (changed_ + 1 < window_.size()) go_on(changed_);
  }
}

void Ekf::go_on(int k) noexcept {
  StageBelief& next = before(k + 1);
  next = newest_;
  predict(next, window_.transition_from(k, newest_.z), newest_.z);
}

}  // namespace mrroc::rex
