// A kinematic effector and cameras that know the truth: the whole loop without renderings, links or physics.
#pragma once
#include <deque>
#include <functional>
#include <random>
#include <vector>

#include "base/representation.hpp"
#include "tasks/visual_servo/camera_links.hpp"
#include "tasks/visual_servo/program.hpp"
#include "tasks/visual_servo/servo.hpp"

namespace mrroc::visual_servo::test {

inline constexpr double kDt = 0.002;
inline constexpr double kPi = 3.14159265358979323846;

/// The object lies in front of the arm, its z upwards.
inline Pose object_at(double x, double y, double z, double turn = 0) {
  return {rotation_from_angle_axis({0, 0, turn}), {x, y, z}};
}

/// A camera above the table that looks down and is 1.8 m away from it, one in the hand, and a desired pose in which the
/// object lies in the middle of the latter's picture.
inline Parameters parameters() {
  Parameters k;
  k.camera[0].place = {rotation_from_angle_axis({kPi, 0, 0}), {0.95, 0, 1.85}};
  k.camera[1].place = {rotation_from_angle_axis({0, 0, kPi / 2}), {0.08, 0, -0.1}};
  k.T_EGd = {rotation_from_angle_axis({kPi, 0, 0}), {0.08, 0, 0.25}};
  k.duration = 200;
  return k;
}

/// Parameters of a cell.
struct CellParameters {
  Parameters k = parameters();
  std::function<Pose(double t)> object = [](double) { return object_at(1, 0, 0.05); };
  /// Hides the object from a camera, beyond what its field of view does.
  std::function<bool(Camera, double t, const Pose& T_0E, const Pose& T_0G)> hidden = [](auto&&...) {
    return false;
  };
  /// The reading of a frame does not come.
  std::function<bool(Camera, std::int64_t frame)> lost = [](auto&&...) { return false; };
  std::array<double, kCameras> position_noise{1.2e-3, 2e-4};  ///< standard deviation along each axis [m]
  std::array<double, kCameras> angle_noise{4e-3, 1e-3};       ///< about each axis [rad]
  double lag{0.03};                                           ///< time constant of the drives [s]
  Pose T_0E = {rotation_from_angle_axis({kPi, 0, 0}), {0.8, 0.05, 0.5}};
  unsigned seed{1};
};

/// A port of the agent. Commands are executed, and answered, as late as over the links.
class SyntheticCell {
 public:
  /// What happened in one control step.
  struct Row {
    int m{};
    bool sac{}, eih{};
    Pose e, T_dc;
    double true_mm{}, true_deg{};  ///< error when x_c was looked at
    Pose T_0E;                     ///< then
    double t{};
  };

  explicit SyntheticCell(CellParameters p)
      : p_(std::move(p)), random_(p_.seed), T_0Es_(p_.T_0E), T_0E_(p_.T_0E) {
    macrostep({});  // the one before the first x_ce
  }

  void dispatch(const Motion<Arm>& motion, const Arm::Y& y) {
    rows.back().m = motion.m;
    rows.back().e = y.c.e;
    rows.back().T_dc = y.c.under_way;
    commands_.push_back(y.e);
  }
  Outcome wait() {
    macrostep(commands_.front());
    commands_.pop_front();
    return ++i_ < 5000 ? Outcome::terminated : Outcome::aborted;
  }
  void read(Arm::X& x) {
    x.i = i_;
    x.e.step = reading_step_;
    const AngleAxisPose r = angle_axis_from_pose(path_.at(static_cast<std::size_t>(reading_step_)));
    std::ranges::copy(r, x.e.T_0E.begin());
    for (std::size_t n = 0; n < kCameras; ++n) look(n, x.V.camera[n]);
    const double t = static_cast<double>(reading_step_) * kDt;
    const Pose& T_0E = path_[static_cast<std::size_t>(reading_step_)];
    const Pose error = T_0E.inverse() * p_.object(t) * p_.k.T_EGd.inverse();
    Row& row = rows.emplace_back();
    row.sac = sees(x, Camera::sac);
    row.eih = sees(x, Camera::eih);
    row.true_mm = 1e3 * error.p.norm();
    row.true_deg = 180 / kPi * angle_axis_from_rotation(error.R).norm();
    row.T_0E = T_0E;
    row.t = t;
  }

  /// Executes the whole task.
  Outcome run() {
    Arm::X x;
    x.c = begin(p_.k, i_);
    read(x);
    const Outcome outcome = run_program(x, *this);
    rows.pop_back();  // the last image, of which nothing was made
    return outcome;
  }

  /// @return control steps until the true error stays below so many mm; -1: never
  [[nodiscard]] int steps_to(double mm) const {
    int k = static_cast<int>(rows.size());
    while (k > 0 && rows[static_cast<std::size_t>(k - 1)].true_mm < mm) --k;
    return k == static_cast<int>(rows.size()) ? -1 : k;
  }
  /// @return largest true error over the last rows
  [[nodiscard]] double worst_mm(std::size_t last) const {
    double worst = 0;
    for (std::size_t k = rows.size() - last; k < rows.size(); ++k) worst = std::max(worst, rows[k].true_mm);
    return worst;
  }

  std::vector<Row> rows;

 private:
  void macrostep(const EffectorCommand& command) {
    const int n_s = p_.k.pacing.n_s;
    const bool moves = has(command.set, Part::arm);
    if (moves) {
      per_step_ =
          angle_axis_from_pose(*pose_from_numbers(command.arm.representation, command.arm.pose)) / n_s;
      stopped_for_ = 0;
    }
    for (int step = 1; step <= n_s; ++step) {
      if (step == p_.k.pacing.n_Q) reading_step_ = static_cast<std::int64_t>(path_.size());
      path_.push_back(T_0E_);
      if (!moves) ++stopped_for_;
      const double speed = std::max(0., 1 - stopped_for_ / 40.);
      T_0Es_ = T_0Es_ * pose_from_angle_axis(speed * per_step_);
      const AngleAxisPose behind = angle_axis_from_pose(T_0E_.inverse() * T_0Es_);
      T_0E_ = T_0E_ * pose_from_angle_axis(kDt / (p_.lag + kDt) * behind);
    }
  }

  void look(std::size_t n, CameraImage& image) {
    std::int64_t frame = newest_frame(p_.k.camera[n], reading_step_);
    while (frame >= 0 && p_.lost(static_cast<Camera>(n), frame)) --frame;
    if (frame < 0) return;
    const CameraReading r = reading(n, frame);
    image = {true, r, path_[static_cast<std::size_t>(r.step)]};
  }

  /// The same frame gives the same reading, however often it is looked at.
  CameraReading reading(std::size_t n, std::int64_t frame) {
    auto& made = made_[n];
    while (static_cast<std::int64_t>(made.size()) <= frame)
      made.push_back(take_picture(n, static_cast<std::int64_t>(made.size())));
    return made[static_cast<std::size_t>(frame)];
  }
  CameraReading take_picture(std::size_t n, std::int64_t frame) {
    CameraReading r;
    r.frame = frame;
    r.step = frame * p_.k.camera[n].period;
    const double t = static_cast<double>(r.step) * kDt;
    const Pose& T_0E = path_.at(static_cast<std::size_t>(r.step));
    const Pose T_0C = n == 0 ? p_.k.camera[n].place : T_0E * p_.k.camera[n].place;
    const Pose T_0G = p_.object(t);
    const Pose T_CG = T_0C.inverse() * T_0G;
    r.seen = in_view(T_CG) && !p_.hidden(static_cast<Camera>(n), t, T_0E, T_0G);
    if (!r.seen) return r;
    std::normal_distribution<double> normal;
    Vector6 d;
    for (int k = 0; k < 6; ++k) {
      const double deviation = k < 3 ? p_.position_noise[n] : p_.angle_noise[n];
      d[k] = deviation * normal(random_);
      r.covariance(k, k) = deviation * deviation;
    }
    r.T_CG = {rotation_from_angle_axis(d.tail<3>()) * T_CG.R, T_CG.p + d.head<3>()};
    return r;
  }
  /// The corners of a board of 10 x 7 squares of 25 mm are in the picture.
  static bool in_view(const Pose& T_CG) {
    const CameraModel camera;
    for (const double x : {-0.125, 0.125})
      for (const double y : {-0.0875, 0.0875}) {
        const Vector3 p = T_CG * Vector3(x, y, 0);
        if (p.z() < 0.1) return false;
        const Vector2 uv = project(camera, p);
        if (uv.x() < 0 || uv.y() < 0 || uv.x() > camera.width || uv.y() > camera.height) return false;
      }
    return true;
  }

  CellParameters p_;
  std::mt19937 random_;
  Pose T_0Es_, T_0E_;  // set, and as the drives have it
  AngleAxisPose per_step_ = AngleAxisPose::Zero();
  double stopped_for_{40};
  std::vector<Pose> path_;  // measured, by step
  std::int64_t reading_step_{};
  std::int64_t i_{};
  std::deque<EffectorCommand> commands_{{}};
  std::array<std::vector<CameraReading>, kCameras> made_;
};

}  // namespace mrroc::visual_servo::test
