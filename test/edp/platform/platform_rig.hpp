// A driver with the fake platform, its drives and sensors, and a control subsystem that says what a test likes.
#pragma once
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "edp/platform/driver.hpp"
#include "test/edp/platform/fake_platform.hpp"

namespace mrroc::edp::test {

/// The body and the sensors of a platform whose wheels never slip.
class FakeGround {
 public:
  PlanarPose p{0.5, -0.2, 0.3};  ///< true
  double v{};                    ///< [m/s]
  double w{};                    ///< [rad/s]
  double push{};                 ///< [m/s^2], along x of B
  double gyro_bias{0.01};        ///< [rad/s]
  std::array<bool, kWheels> blocked{};
  std::array<bool, kWheels> encoder_stuck{};
  bool imu_silent{};
  bool imu_not_finite{};
  bool load_silent{};
  double load_scale{1};
  std::int64_t step{};

  [[nodiscard]] PlatformReading reading() const {
    PlatformReading r;
    r.step = step;
    for (std::size_t k = 0; k < kWheels; ++k)
      r.encoder[k] = static_cast<std::int32_t>(
          static_cast<std::int64_t>(std::floor(theta_[k] * kIncrements / (2 * std::numbers::pi))));
    r.yaw = imu_not_finite ? std::nan("") : yaw_;
    r.yaw_rate = w + gyro_bias;
    r.imu_valid = !imu_silent;
    r.load.fill(load_scale * kMass * 9.81 / 4);
    r.load_valid = !load_silent;
    return r;
  }

  void apply(const PlatformDrive& drive) {
    const double dt = PlatformDriver::kStep;
    double force = 0;
    double moment = 0;
    bool any_blocked = false;
    for (std::size_t k = 0; k < kWheels; ++k) {
      const double side = k % 2 == 0 ? -1 : 1;
      const double speed = (v + side * kHalfTrack * w) / kRadius;
      const double torque = drive.enabled ? drive.torque[k] : -kBrake * speed;
      any_blocked = any_blocked || blocked[k];
      force += torque / kRadius;
      moment += side * kHalfTrack * torque / kRadius;
    }
    v += (force / kMass + push) * dt;
    w += moment / kInertia * dt;
    if (any_blocked) v = w = 0;
    p.phi += w * dt / 2;
    p.x += v * dt * std::cos(p.phi);
    p.y += v * dt * std::sin(p.phi);
    p.phi = wrap_angle(p.phi + w * dt / 2);
    for (std::size_t k = 0; k < kWheels; ++k)
      if (!encoder_stuck[k]) theta_[k] += dt * (v + (k % 2 == 0 ? -1 : 1) * kHalfTrack * w) / kRadius;
    yaw_ = drive.imu_reset ? 0 : yaw_ + w * dt;
    ++step;
  }

 private:
  PerWheel theta_{1, 2, 3, 4};
  double yaw_{0.7};
};

/// Makes fragments that go on from one another: speeds and turn rates change linearly.
class Way {
 public:
  explicit Way(const PathPoint& from) : last_(from) {}
  /// @return the next fragment, which ends with these speeds
  Fragment next(double v, double w, std::int32_t steps, std::int32_t notify = 0) {
    Fragment f;
    f.number = ++number;
    f.steps = steps;
    f.notify = notify;
    f.knot[0] = last_;
    constexpr int kPieces = 50;
    const double dt = steps * kPlatformPeriod / (kPieces * static_cast<double>(kFragmentKnots - 1));
    const double dv = (v - last_.v) / (kPieces * static_cast<double>(kFragmentKnots - 1));
    const double dw = (w - last_.w) / (kPieces * static_cast<double>(kFragmentKnots - 1));
    for (std::size_t k = 1; k < kFragmentKnots; ++k) {
      for (int j = 0; j < kPieces; ++j) {
        last_.v += dv / 2;
        last_.w += dw / 2;
        last_.p.phi += last_.w * dt / 2;
        last_.p.x += last_.v * dt * std::cos(last_.p.phi);
        last_.p.y += last_.v * dt * std::sin(last_.p.phi);
        last_.p.phi += last_.w * dt / 2;
        last_.v += dv / 2;
        last_.w += dw / 2;
      }
      f.knot[k] = last_;
    }
    return f;
  }
  [[nodiscard]] const PathPoint& end() const { return last_; }
  std::int64_t number{};  ///< of the last fragment

 private:
  PathPoint last_;
};

/// Driver and ground, stepped together.
class PlatformRig {
 public:
  static PlatformDriverParameters parameters() {
    PlatformDriverParameters p;
    p.synchro_rest = 0.2;
    p.synchro_timeout = 2;
    return p;
  }

  explicit PlatformRig(const PlatformDriverParameters& p = parameters()) : driver(platform, p) {}
  PlatformRig(const PlatformRig&) = delete;
  PlatformRig& operator=(const PlatformRig&) = delete;

  FakePlatform platform;
  PlatformDriver driver;
  FakeGround ground;
  std::int64_t number{};                  ///< of the last command
  double pace{1};                         ///< in every message
  bool map_seen{true};                    ///< the messages have a position
  OdometryReading odometry;               ///< in every message
  std::function<void()> after_each_step;  ///< looks at the rig
  PlatformDrive last;

  /// @return a message with what is not numbered
  PlatformCommand keep() {
    if (ground.step % 50 == 0) {
      map.valid = map_seen;
      map.step = ground.step;
      map.p = ground.p;
      map.covariance = {2.5e-5, 0, 0, 0, 2.5e-5, 0, 0, 0, 1e-4};
    }
    PlatformCommand c;
    c.session = 7;
    c.number = number;
    c.macrostep = ground.step / kPlatformSteps + 1;
    c.pace = pace;
    c.map = map;
    c.odometry = odometry;
    return c;
  }
  /// @return a command with the next number
  PlatformCommand command(Instruction instruction) {
    PlatformCommand c = keep();
    c.number = ++number;
    c.instruction = instruction;
    return c;
  }
  PlatformCommand set(const Fragment& fragment) {
    PlatformCommand c = command(Instruction::set);
    c.fragment = fragment;
    return c;
  }

  void step() {
    last = driver.step(ground.reading());
    ground.apply(last);
    if (after_each_step) after_each_step();
  }
  /// One macrostep without any message. @return its reply
  PlatformReply quiet() {
    PlatformReply reply{};
    do {
      step();
      if (driver.reply_due()) reply = driver.reply();
    } while (!driver.at_boundary());
    return reply;
  }
  /// One macrostep. @return its reply
  PlatformReply macrostep(const PlatformCommand& c) {
    driver.take(c);
    return quiet();
  }
  /// Macrosteps with keep. @return the last reply
  PlatformReply wait(int macrosteps) {
    PlatformReply reply{};
    for (int k = 0; k < macrosteps; ++k) reply = macrostep(keep());
    return reply;
  }
  /// Waits for a state. @return whether it has come
  bool reach(DriverState state, int macrosteps = 400) {
    for (int k = 0; k < macrosteps && driver.state() != state; ++k) wait(1);
    return driver.state() == state;
  }
  /// SYNCHRO until the platform is ready.
  bool synchronise() {
    macrostep(command(Instruction::synchro));
    return reach(DriverState::ready);
  }
  /// @return a way that begins where the platform is
  [[nodiscard]] Way way() const { return Way({driver.estimate().estimate.p, 0, 0}); }
  /// @return distance of the platform from a point [m]
  [[nodiscard]] double away(const PlanarPose& p) const {
    return std::hypot(ground.p.x - p.x, ground.p.y - p.y);
  }

  MapPose map;  ///< the last one
};

}  // namespace mrroc::edp::test
