#include "vsp/odometry/stereo_odometry.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "vsp/odometry/consensus.hpp"
#include "vsp/odometry/features.hpp"
#include "vsp/odometry/matching.hpp"
#include "vsp/odometry/motion.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp {
namespace {

/// What is kept of a pair.
struct KeptPair {
  cv::Mat left, right;  // grey
  StereoPair pyramids;
  std::int64_t step{};
  bool fresh{true};  // neither picture is the one of the pair before
};

bool is_same(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0; }

void write(const StereoMotion& motion, OdometryReading& reading) {
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(reading.A.data()) << motion.A.R, motion.A.p;
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(reading.covariance.data()) = motion.covariance;
}

}  // namespace

class StereoOdometry::Memory {
 public:
  Memory(const StereoRig& rig, const StereoOdometryParameters& parameters)
      : rig_(rig), parameters_(parameters) {}

  OdometryReading step(const ImageView& left, const ImageView& right, std::int64_t frame, std::int64_t step) {
    support_ = {};
    support_.frame = frame;
    OdometryReading reading;
    reading.step = step;
    std::optional<KeptPair> now = pair_of(left, right, step);
    if (before_ && now) {
      now->fresh = !is_same(before_->left, now->left) && !is_same(before_->right, now->right);
      if (before_->fresh && now->fresh && before_->step < step) measure(*before_, *now, reading);
    }
    before_ = std::move(now);
    return reading;
  }
  [[nodiscard]] const OdometrySupport& support() const { return support_; }

 private:
  std::optional<KeptPair> pair_of(const ImageView& left, const ImageView& right, std::int64_t step) const {
    if (!fits(left, rig_.left()) || !fits(right, rig_.left())) return std::nullopt;
    KeptPair pair{grey(left).clone(), grey(right).clone(), {}, step};
    pair.pyramids = {pyramid_of(pair.left), pyramid_of(pair.right)};
    return pair;
  }
  void measure(const KeptPair& before, const KeptPair& now, OdometryReading& reading) {
    reading.step_before = before.step;
    const auto matches = stereo_matches(rig_, before.pyramids, now.pyramids, corners(before.left));
    support_.matches = static_cast<int>(matches.size());
    const auto found = consensus(rig_, matches);
    if (!found) return;
    const StereoMotion motion = refined(rig_, matches, *found);
    std::set<int> cells;
    for (const std::size_t k : motion.inliers) cells.insert(cell_of(matches[k].pixel, before.left.size()));
    support_.inliers = static_cast<int>(motion.inliers.size());
    support_.cells = static_cast<int>(cells.size());
    support_.rms_px = motion.rms_px;
    reading.valid = support_.inliers >= parameters_.inliers && support_.cells >= parameters_.cells &&
                    support_.rms_px < parameters_.rms_px && motion.A.p.norm() <= parameters_.way;
    if (reading.valid) write(motion, reading);
  }

  StereoRig rig_;
  StereoOdometryParameters parameters_;
  std::optional<KeptPair> before_;
  OdometrySupport support_;
};

StereoOdometry::StereoOdometry(const StereoRig& rig, const StereoOdometryParameters& parameters)
    : memory_(std::make_unique<Memory>(rig, parameters)) {}
StereoOdometry::StereoOdometry(StereoOdometry&&) noexcept = default;
StereoOdometry& StereoOdometry::operator=(StereoOdometry&&) noexcept = default;
StereoOdometry::~StereoOdometry() = default;

OdometryReading StereoOdometry::step(const ImageView& left, const ImageView& right, std::int64_t frame,
                                     std::int64_t step) {
  return memory_->step(left, right, frame, step);
}

const OdometrySupport& StereoOdometry::support() const { return memory_->support(); }

}  // namespace mrroc::vsp
