#include "tasks/haptic/hand_way.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/fault.hpp"

namespace mrroc::haptic {
namespace {

using std::numbers::pi;

constexpr double kStep = 0.01;    // between points [s]
constexpr double kRest = 1;       // [s]
constexpr double kFree = 0.01;    // in front of what is met [m]
constexpr double kSlide = 0.01;   // along what is met [m]
constexpr double kBelow = 0.02;   // the top of the plate, where its side is met [m]
constexpr double kTable = 0.005;  // the master stays so high above its own [m]

double smooth(double u) { return u * u * (3 - 2 * u); }

/// Writes the way of the slave in its sheet; where the hand pushes, the hand goes beyond by what that takes.
class Writer {
 public:
  Writer(const Scene& scene, const Law& law, const OperatorPlan& plan)
      : scene_(scene), law_(law), plan_(plan), at_(start()) {}

  std::vector<mp::WayPoint> write() {
    rest(kRest);
    circle();
    const double low = scene_.top - kBelow;
    go({0, scene_.side - kFree, scene_.height}, plan_.speed);
    go({0, scene_.side - kFree, low}, plan_.speed);
    touch({0, scene_.side, low}, Vector3::UnitY());
    go({0, scene_.side - kFree, scene_.height}, plan_.speed);
    const double middle = scene_.side + scene_.depth / 2;
    go({0, middle, scene_.height}, plan_.speed);
    go({0, middle, scene_.top + kFree}, plan_.speed);
    touch({0, middle, scene_.top}, -Vector3::UnitZ());
    go({0, middle, scene_.height}, plan_.speed);
    go(start(), plan_.speed);
    rest(kRest);
    return std::move(points_);
  }

 private:
  [[nodiscard]] Vector3 start() const { return {0, 0, scene_.height}; }

  void rest(double time) {
    for (double t = 0; t < time; t += kStep) add(at_);
  }
  /// @param speed  of the hand
  void go(const Vector3& to, double speed) {
    const Vector3 from = at_;
    const double time = std::max(1.5 * (to - from).norm() / law_.motion_scale / speed, kStep);
    for (double t = 0; t < time; t += kStep) add(from + smooth(t / time) * (to - from));
    add(to);
  }
  void circle() {
    const double r = law_.motion_scale * plan_.circle;
    const double time = 1.5 * 2 * pi * plan_.circle / plan_.speed;
    for (double t = 0; t < time; t += kStep) {
      const double angle = 2 * pi * smooth(t / time);
      add(start() + r * Vector3(std::sin(angle), std::cos(angle) - 1, 0));
    }
    add(start());
  }
  /// Against a surface, along it and back, and off it.
  void touch(const Vector3& surface, const Vector3& into) {
    const double force = plan_.push / law_.force_scale;  // of the slave
    const double spring = plan_.slave_mobility / plan_.return_rate + 1 / scene_.stiffness;
    const Vector3 pushed =
        surface + (force * spring + law_.motion_scale * plan_.push * scene_.compliance) * into;
    const Vector3 before = at_;
    go(pushed, plan_.touch);
    rest(plan_.hold);
    for (const double x : {kSlide, 0.0}) go(pushed + x * Vector3::UnitX(), plan_.touch);
    rest(plan_.hold / 2);
    go(before, plan_.touch);
  }
  void add(const Vector3& slave) {
    at_ = slave;
    const Vector3 master = start() + (slave - start()) / law_.motion_scale;
    if (master.z() < kTable)
      throw FaultError(
          FaultCode::bad_configuration,
          fmt::format("where arm2 is on its plate, arm1 would be at {:.0f} mm over its own table",
                      1e3 * master.z()),
          "make task.motion_scale larger, or robots.arm2.plate.thickness");
    points_.push_back({t_, scene_.T_0P * master});
    t_ += kStep;
  }

  Scene scene_;
  Law law_;
  OperatorPlan plan_;
  Vector3 at_;
  std::vector<mp::WayPoint> points_;
  double t_{};
};

}  // namespace

std::vector<mp::WayPoint> hand_way(const Scene& scene, const Law& law, const OperatorPlan& plan) {
  return Writer(scene, law, plan).write();
}

}  // namespace mrroc::haptic
