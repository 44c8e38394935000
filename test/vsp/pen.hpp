// A pen that moves along its axis, for tests of the receptor that tells its state.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/pose.hpp"
#include "vsp/pen_state/pen_state_sensor.hpp"

namespace mrroc::vsp::test {

inline constexpr double kDt = 0.002;
inline constexpr int kSteps = 10;  // of a macrostep

/// A pen that moves along its axis, somewhere in the base, and everything that its sensor said.
class Pen {
 public:
  explicit Pen(const Vector3& turn = {std::numbers::pi, 0, 0}, const PenStateParameters& k = {},
               double rest_first = 0.6)
      : sensor(k), T_{rotation_from_angle_axis(turn), {0.3, -0.2, 0.9}} {
    rest(0, rest_first);
  }

  /// @param v  speed into the paper [m/s]
  /// @param F  force along the pen [N]
  void move(double v, double F, double seconds) {
    go([v](double) { return v; }, [F](double) { return F; }, seconds);
  }
  void rest(double F, double seconds) { move(0, F, seconds); }
  template <class V, class F>
  void go(V speed, F force, double seconds) {
    const int steps = static_cast<int>(std::lround(seconds / kDt));
    for (int k = 0; k < steps; ++k) {
      const double t = k * kDt;
      depth += speed(t) * kDt;
      step(force(t));
    }
  }
  void step(double F) {
    StepSample s;
    Pose T = T_;
    T.p += T_.R.col(2) * depth + T_.R.col(0) * aside;
    Eigen::Map<AngleAxisPose>(s.T_0E.data()) = angle_axis_from_pose(T);
    s.F_a[Axis::z] = F;
    sensor.step(s);
    if (states.empty() || states.back() != sensor.state()) states.push_back(sensor.state());
    if (++steps_ % kSteps != 0) return;
    const auto read = static_cast<PenState>(sensor.reading().state);
    lift_offs_read += read == PenState::lift_off;
    last_read = read;
  }
  /// Lowers as in m = 4, hits the paper and presses with the force that stands afterwards.
  void touch(double F = 1) {
    move(0.01, 0, 0.5);
    go([](double t) { return 0.01 * std::exp(-t / 0.01); },
       [](double t) { return 3 * (1 - std::exp(-t / 0.004)); }, 0.05);
    go([](double) { return 0; }, [F](double t) { return F + (3 - F) * std::exp(-t / 0.05); }, 0.6);
  }

  PenStateSensor sensor;
  double depth{};
  double aside{};
  std::vector<PenState> states;  ///< each one that was entered
  int lift_offs_read{};
  PenState last_read{};

 private:
  Pose T_;
  int steps_{};
};

}  // namespace mrroc::vsp::test
