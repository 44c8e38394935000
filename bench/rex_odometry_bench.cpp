// Visual odometry of a platform in rooms of random seeds: how far it drifts, and its work per pair of pictures.
#include <algorithm>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "bench/figures.hpp"
#include "bench/vision.hpp"
#include "test/vsp/hard_rooms.hpp"
#include "test/vsp/stereo_room.hpp"
#include "vsp/odometry/stereo_odometry.hpp"

namespace mrroc::bench {
namespace {

constexpr unsigned kRooms = 20;
constexpr int kPairs = 120;  // of a way
constexpr int kSubWay = 40;  // pairs over which the drift is taken
constexpr std::int64_t kPeriod = 40;

struct Measured {
  std::vector<double> ms;         // of each pair
  std::vector<double> drift_pct;  // of each sub-way
  int invalid{};
};

Pose motion_of(const OdometryReading& r) {
  Pose A;
  A.R << r.A[0], r.A[1], r.A[2], r.A[4], r.A[5], r.A[6], r.A[8], r.A[9], r.A[10];
  A.p << r.A[3], r.A[7], r.A[11];
  return A;
}

void drive(unsigned seed, Measured& measured) {
  test::StereoRoom room({.seed = seed});
  test::RandomWay way(seed);
  vsp::StereoOdometry odometry(test::stereo_rig());
  Pose truth, estimate;  // from the beginning of the sub-way
  double length = 0;
  for (int k = 0; k <= kPairs; ++k) {
    const Pose A = k > 0 ? way.go_on() : Pose{};
    const test::PicturePair pair = room.pair(way.T_UB(), k);
    const double begun = thread_ms();
    const OdometryReading r = odometry.step(pair.left.view(), pair.right.view(), k, k * kPeriod);
    measured.ms.push_back(thread_ms() - begun);
    if (k == 0) continue;
    if (!r.valid) ++measured.invalid;
    truth = truth * A;
    estimate = estimate * (r.valid ? motion_of(r) : Pose{});
    length += A.p.norm();
    if (k % kSubWay != 0) continue;
    measured.drift_pct.push_back(100 * (estimate.p - truth.p).norm() / length);
    truth = estimate = {};
    length = 0;
  }
}

/// Rooms that nobody tuned the odometry to.
Figures hard_room_figures() {
  constexpr unsigned kSeed = 301;
  constexpr int kPairsAtASpeed = 25;
  Figures figures;
  for (const test::HardRoom& room : test::hard_rooms(kSeed)) {
    const test::HardRoomResult r = test::drive_through(room, kPairsAtASpeed);
    std::string key = "odometry_" + room.name;
    std::ranges::replace(key, ' ', '_');
    const auto percent = [](int part, int all) { return all > 0 ? 100.0 * part / all : 0; };
    figures.push_back({key + "_valid_pct", percent(r.valid, r.pairs), "%",
                       "room or cameras: " + room.name + ", pairs with a motion"});
    if (r.valid == 0) continue;
    figures.push_back(
        {key + "_wrong_pct", percent(r.wrong, r.valid), "%", "  of these beyond 99.9 % of their covariance"});
    figures.push_back({key + "_misleading_pct", percent(r.misleading, r.valid), "%",
                       "  beyond what an estimator allows for, wanted 0"});
    figures.push_back(
        {key + "_nees", r.nees, "", "  mean square of the error in its covariance, 3 is honest"});
    figures.push_back({key + "_worst_mm", r.worst_mm, "mm", "  largest error from pair to pair"});
    figures.push_back({key + "_drift_pct", r.drift_pct, "%", "  drift"});
  }
  return figures;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

}  // namespace

Figures rex_odometry_figures() {
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);  // other threads would hide work from thread_ms()
  Measured measured;
  for (unsigned seed = 101; seed <= 100 + kRooms; ++seed) drive(seed, measured);
  const Figures hard = hard_room_figures();
  cv::setNumThreads(threads);
  Figures figures{
      {"odometry_drift_pct", mean(measured.drift_pct), "%",
       "error of the position over sub-ways of 40 pairs against their length, in 20 rooms, mean"},
      {"odometry_cpu_ms", mean(measured.ms), "ms", "processor time of a pair of 640 x 480 pictures, mean"},
      {"odometry_cpu_ms_p99", quantile(measured.ms, 0.99), "ms", "the same, 99 % quantile"},
      {"odometry_invalid", static_cast<double>(measured.invalid), "", "pairs without a motion, of 2,400"}};
  figures.insert(figures.end(), hard.begin(), hard.end());
  return figures;
}

}  // namespace mrroc::bench
