#include "vsp/odometry/consensus.hpp"

#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>

#include "vsp/odometry/reprojection.hpp"

namespace mrroc::vsp {
namespace {

constexpr double kInlier = 1.5;  // [pixel]
constexpr int kSamples = 100;
constexpr double kSure = 0.999;  // probability with which a sample without outliers has been drawn
constexpr std::size_t kLeastInliers = 6;

using Sample = std::array<std::size_t, 3>;

/// Three different numbers below `count`, which is at least 3.
Sample draw(std::minstd_rand& random, std::size_t count) {
  const auto number = [&](std::size_t most) { return static_cast<std::size_t>(random()) % most; };
  const std::size_t a = number(count);
  const std::size_t b = (a + 1 + number(count - 1)) % count;
  std::size_t c = number(count);
  while (c == a || c == b) c = (c + 1) % count;
  return {a, b, c};
}

/// @return up to four motions of the platform that explain where the left camera sees the three points
std::vector<Pose> motions(const StereoRig& rig, const std::vector<StereoMatch>& matches,
                          const Sample& sample) {
  std::array<cv::Point3d, 3> points;
  std::array<cv::Point2d, 3> rays;
  for (std::size_t k = 0; k < sample.size(); ++k) {
    const StereoMatch& m = matches[sample[k]];
    points[k] = {m.point.x(), m.point.y(), m.point.z()};
    rays[k] = {m.seen[0] / rig.f(), m.seen[1] / rig.f()};
  }
  std::vector<cv::Vec3d> turns, ways;
  cv::solveP3P(points, rays, cv::Matx33d::eye(), cv::noArray(), turns, ways, cv::SOLVEPNP_P3P);
  std::vector<Pose> all;
  for (std::size_t k = 0; k < turns.size(); ++k) {
    Pose T_SB;  // of B at the first pair, in S at the second
    T_SB.R = rotation_from_angle_axis({turns[k][0], turns[k][1], turns[k][2]});
    T_SB.p = {ways[k][0], ways[k][1], ways[k][2]};
    all.push_back((rig.T_BS() * T_SB).inverse());
  }
  return all;
}

bool agrees(const StereoRig& rig, const StereoMatch& match, const Pose& A) {
  const StereoPlace error = reprojected(rig, A, match.point) - match.seen;
  return error.head<2>().norm() <= kInlier && error.tail<2>().norm() <= kInlier;
}

/// @return how many samples are enough when this share of the matches are inliers
double enough_samples(double share) {
  const double good = std::pow(share, 3);
  return good < 1 ? std::log(1 - kSure) / std::log(1 - good) : 1;
}

}  // namespace

std::vector<std::size_t> inliers(const StereoRig& rig, const std::vector<StereoMatch>& matches,
                                 const Pose& A) {
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < matches.size(); ++k)
    if (agrees(rig, matches[k], A)) numbers.push_back(k);
  return numbers;
}

std::optional<Pose> consensus(const StereoRig& rig, const std::vector<StereoMatch>& matches) {
  std::optional<Pose> best;
  if (matches.size() < kLeastInliers) return best;
  std::minstd_rand random(1);
  std::size_t most = kLeastInliers - 1;
  double enough = kSamples;
  for (int k = 0; k < kSamples && k < enough; ++k)
    for (const Pose& A : motions(rig, matches, draw(random, matches.size())))
      if (const std::size_t count = inliers(rig, matches, A).size(); count > most) {
        most = count;
        best = A;
        enough = enough_samples(static_cast<double>(most) / static_cast<double>(matches.size()));
      }
  return best;
}

}  // namespace mrroc::vsp
