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

/// Whether hardly any light fell into a camera.
bool is_dark(const KeptPair& pair) {
  constexpr double kDark = 8;  // mean grey value
  return std::min(cv::mean(pair.left)[0], cv::mean(pair.right)[0]) < kDark;
}

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
    seen_.clear();
    support_.frame = frame;
    OdometryReading reading;
    reading.step = step;
    std::optional<KeptPair> now = pair_of(left, right, step);
    if (before_ && now) {
      now->fresh = !is_same(before_->left, now->left) && !is_same(before_->right, now->right);
      support_.finding = found(*before_, *now, reading);
    } else if (!now) {
      support_.finding = OdometryFinding::no_picture;
    }
    reading.valid = support_.finding == OdometryFinding::motion;
    if (!reading.valid) last_.reset();
    before_ = std::move(now);
    return reading;
  }
  [[nodiscard]] const OdometrySupport& support() const { return support_; }
  [[nodiscard]] const std::vector<SeenPoint>& seen() const { return seen_; }

 private:
  std::optional<KeptPair> pair_of(const ImageView& left, const ImageView& right, std::int64_t step) const {
    if (!fits(left, rig_.left()) || !fits(right, rig_.left())) return std::nullopt;
    KeptPair pair{grey(left).clone(), grey(right).clone(), {}, step};
    pair.pyramids = {pyramid_of(pair.left), pyramid_of(pair.right)};
    return pair;
  }
  OdometryFinding found(const KeptPair& before, const KeptPair& now, OdometryReading& reading) {
    if (before.step >= now.step) return OdometryFinding::no_before;
    reading.step_before = before.step;
    const OdometryFinding finding =
        before.fresh && now.fresh ? measure(before, now, reading) : OdometryFinding::frozen;
    const bool rests_on_little = finding != OdometryFinding::motion && finding != OdometryFinding::inexact &&
                                 finding != OdometryFinding::far;
    return rests_on_little && (is_dark(now) || is_dark(before)) ? OdometryFinding::dark : finding;
  }
  OdometryFinding measure(const KeptPair& before, const KeptPair& now, OdometryReading& reading) {
    const std::vector<Vector2> features = corners(before.left);
    support_.features = static_cast<int>(features.size());
    if (support_.features < parameters_.inliers) return OdometryFinding::blank;
    const StereoMatches matches = stereo_matches(rig_, before.pyramids, now.pyramids, features);
    support_.matches = static_cast<int>(matches.points.size());
    for (const StereoMatch& match : matches.points) seen_.push_back({match.pixel, match.now});
    if (support_.matches < parameters_.inliers)
      return matches.crossed >= parameters_.inliers ? OdometryFinding::swapped : OdometryFinding::unmatched;
    const auto agreed = consensus(rig_, matches.points);
    if (!agreed) return OdometryFinding::few_inliers;
    const StereoMotion motion = refined(rig_, matches.points, *agreed);
    const OdometryFinding finding = judge(motion, matches.points, before.left.size());
    if (finding != OdometryFinding::motion) return finding;
    const Motion last{motion.A.p, now.step - before.step};
    if (!follows(last)) return OdometryFinding::far;
    last_ = last;
    write(motion, reading);
    return finding;
  }
  OdometryFinding judge(const StereoMotion& motion, const std::vector<StereoMatch>& matches,
                        const cv::Size& size) {
    std::set<int> cells;
    for (const std::size_t k : motion.inliers) {
      seen_[k].inlier = true;
      cells.insert(cell_of(matches[k].pixel, size));
    }
    support_.inliers = static_cast<int>(motion.inliers.size());
    support_.cells = static_cast<int>(cells.size());
    support_.rms_px = motion.rms_px;
    if (support_.inliers < parameters_.inliers || support_.cells < parameters_.cells)
      return OdometryFinding::few_inliers;
    if (!(support_.rms_px < parameters_.rms_px)) return OdometryFinding::inexact;
    return motion.A.p.norm() <= parameters_.way ? OdometryFinding::motion : OdometryFinding::far;
  }

  /// A way and how long it took.
  struct Motion {
    Vector3 p;
    std::int64_t steps{};
  };
  /// @return whether it can come after the motion before, as far as that is known
  [[nodiscard]] bool follows(const Motion& motion) const {
    return !last_ || last_->steps != motion.steps || (motion.p - last_->p).norm() <= parameters_.change;
  }

  StereoRig rig_;
  StereoOdometryParameters parameters_;
  std::optional<Motion> last_;  // that was measured, of the pair before
  std::optional<KeptPair> before_;
  OdometrySupport support_;
  std::vector<SeenPoint> seen_;
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

const std::vector<SeenPoint>& StereoOdometry::seen() const { return memory_->seen(); }

}  // namespace mrroc::vsp
