#include "test/vsp/hard_rooms.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/platform_command.hpp"
#include "vsp/odometry/stereo_odometry.hpp"

namespace mrroc::test {
namespace {

constexpr double kPeriod = 0.08;  // from pair to pair [s]
constexpr std::int64_t kSteps = 40;
constexpr double kRadius = 1.2;              // of the circle [m]
constexpr double kMostChange = 5 * kPeriod;  // of the speed [m/s]
constexpr double kMostError = 16.27;         // 99.9 % of chi-square with three degrees of freedom

struct Stretch {
  double v{}, w{};  // [m/s], [rad/s]
};
constexpr std::array<Stretch, 5> kStretches{
    {{0.3, 0.3 / kRadius}, {0.6, 0.6 / kRadius}, {1, 1 / kRadius}, {1.3, 1.3 / kRadius}, {0, 1.6}}};

/// Of a body that goes along a circle.
Pose motion_along(const SteadyMotion& m) {
  const double half = m.turn / 2;
  const double chord = std::abs(half) > 1e-9 ? m.x * std::sin(half) / half : m.x;
  return {rotation_from_angle_axis({0, 0, m.turn}), {chord * std::cos(half), chord * std::sin(half), 0}};
}

/// Adds up what becomes of the pairs.
class Judge {
 public:
  explicit Judge(HardRoomResult& result) : result_(result) {}

  void begin() {
    truth_ = estimate_ = {};
    length_ = 0;
  }
  void add(const OdometryReading& r, const Pose& A) {
    ++result_.pairs;
    if (!r.valid) return;
    ++result_.valid;
    Pose measured;
    measured.R << r.A[0], r.A[1], r.A[2], r.A[4], r.A[5], r.A[6], r.A[8], r.A[9], r.A[10];
    measured.p << r.A[3], r.A[7], r.A[11];
    truth_ = truth_ * A;
    estimate_ = estimate_ * measured;
    length_ += A.p.norm();
    judge(r, measured, A);
  }
  void end() {
    constexpr double kLeastWay = 0.3;  // [m]
    if (length_ < kLeastWay) return;
    drift_ += 100 * (estimate_.p - truth_.p).norm() / length_;
    result_.drift_pct = drift_ / ++ways_;
  }
  void finish() { result_.nees = result_.valid > 0 ? squares_ / result_.valid : 0; }

 private:
  void judge(const OdometryReading& r, const Pose& measured, const Pose& A) {
    const Vector3 turn = angle_axis_from_rotation(measured.R * A.R.transpose());
    const Vector3 e(measured.p.x() - A.p.x(), measured.p.y() - A.p.y(), turn.z());
    const Eigen::Map<const Matrix6> all(r.covariance.data());
    constexpr std::array<int, 3> kPlanar{0, 1, 5};
    const Matrix3 own = all(kPlanar, kPlanar);
    const double square = e.dot(own.ldlt().solve(e));
    const double floor = std::hypot(5e-4, 0.04 * measured.p.head<2>().norm());
    const Matrix3 allowed =
        own + Matrix3(Vector3(floor * floor, floor * floor, 1.5e-4 * 1.5e-4).asDiagonal());
    squares_ += square;
    result_.wrong += square > kMostError ? 1 : 0;
    result_.misleading += e.dot(allowed.ldlt().solve(e)) > kMostError ? 1 : 0;
    result_.worst_mm = std::max(result_.worst_mm, 1e3 * e.head<2>().norm());
    result_.worst_mrad = std::max(result_.worst_mrad, 1e3 * std::abs(e.z()));
  }

  HardRoomResult& result_;
  Pose truth_, estimate_;
  double length_{}, drift_{}, squares_{};
  int ways_{};
};

}  // namespace

std::vector<HardRoom> hard_rooms(unsigned seed) {
  const double twisted = 0.2 * std::numbers::pi / 180;
  const RoomLook usual{.seed = seed};
  std::vector<HardRoom> rooms{{"usual", usual}};
  const auto add = [&](const char* name, auto change) {
    rooms.push_back({name, usual});
    change(rooms.back().look);
  };
  add("poor in texture", [](RoomLook& r) { r.contrast = 0.1; });
  add("plain walls", [](RoomLook& r) { r.walls = 0; });
  add("poor, plain walls", [](RoomLook& r) { r.contrast = 0.1, r.walls = 0; });
  add("dark", [](RoomLook& r) { r.exposure = 0.1; });
  add("overexposed", [](RoomLook& r) { r.exposure = 2.2; });
  add("glare", [](RoomLook& r) { r.glare = true; });
  add("repeated pattern", [](RoomLook& r) { r.pattern = true; });
  add("noise doubled", [](RoomLook& r) { r.noise = 4; });
  add("lens off by 0.3 %", [](RoomLook& r) { r.lens = 1.003; });
  add("yaw of the pair off by 0.2 deg", [=](RoomLook& r) { r.turned.y() = twisted; });
  add("pitch of the pair off by 0.2 deg", [=](RoomLook& r) { r.turned.x() = twisted; });
  add("roll of the pair off by 0.2 deg", [=](RoomLook& r) { r.turned.z() = twisted; });
  add("out of focus", [](RoomLook& r) { r.defocus = 2.5; });
  add("blurred by motion", [](RoomLook& r) { r.blur = 0.25; });
  return rooms;
}

HardRoomResult drive_through(const HardRoom& room, int pairs) {
  HardRoomResult result;
  Judge judge(result);
  StereoRoom seen(room.look);
  vsp::StereoOdometry odometry(stereo_rig());
  Pose T_UB{Matrix3::Identity(), {0, -kRadius, 0}};
  std::int64_t frame = 0;
  double v = 0;
  for (const Stretch& stretch : kStretches) {
    judge.begin();
    for (int k = 0; k < pairs; ++k, ++frame) {
      v += std::clamp(stretch.v - v, -kMostChange, kMostChange);
      const SteadyMotion steady{kPeriod * v, kPeriod * stretch.w};
      const Pose A = motion_along(steady);
      if (frame > 0) T_UB = T_UB * A;
      const PicturePair pair = seen.pair(T_UB, frame, steady);
      const OdometryReading r = odometry.step(pair.left.view(), pair.right.view(), frame, frame * kSteps);
      if (frame > 0) judge.add(r, A);
    }
    judge.end();
  }
  judge.finish();
  return result;
}

}  // namespace mrroc::test
