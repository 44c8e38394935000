// One platform of the simulation: its wheels, its body, its sensors.
#pragma once
#include <cstdint>
#include <optional>

#include "base/platform_hardware.hpp"
#include "base/platform_transmission.hpp"
#include "sim/platform/motion_capture.hpp"
#include "sim/platform/planar_bodies.hpp"
#include "sim/platform/sensors.hpp"
#include "sim/platform/skid_steer.hpp"

namespace mrroc::sim {

/// Used by PlatformWorld, which integrates the bodies between push() and follow().
class SimulatedPlatform {
 public:
  /// @param world   lives on; its ground and motion capture count here
  /// @param bodies  get the platform's; outlive it
  SimulatedPlatform(const PlatformParameters& platform, const PlatformWorldParameters& world,
                    PlanarBodies& bodies, std::uint64_t seed);

  /// @param step  that begins, 1, 2, ...  @param drive  null: there is none
  void begin_step(std::int64_t step, const PlatformDrive* drive);
  /// Forces of the wheels on the body, for the next integration. @param time  simulated [s] @param h  duration [s]
  void push(double time, double h);
  /// After the integration.
  void follow();
  /// @param integrations  since begin_step()
  void end_step(int integrations);

  /// As PlatformWorld has them.
  [[nodiscard]] const PlatformReading& reading() const { return reading_; }
  [[nodiscard]] const std::optional<CapturedPose>& motion_capture() const { return captured_; }
  [[nodiscard]] const PlatformTruth& truth() const { return truth_; }
  [[nodiscard]] const robots::SkidSteerParameters& body() const { return k_.body; }

  /// Calls visit(double) for every number of the state and of the reading.
  template <class Visit>
  void visit_state(Visit visit) const {
    for (const double each :
         {state_.x, state_.y, state_.phi, state_.vx, state_.vy, state_.w, reading_.yaw, reading_.yaw_rate})
      visit(each);
    wheels_.visit_state(visit);
    for (const std::int32_t each : reading_.encoder) visit(static_cast<double>(each));
    for (const double each : reading_.load) visit(each);
  }

 private:
  void feel_ground(double time);
  void observe(bool imu_reset);

  PlatformParameters k_;
  const PlatformWorldParameters& world_;
  PlanarBodies& bodies_;
  int body_;
  SkidSteer wheels_;
  PlatformSensors sensors_;
  MotionCaptureSystem capture_;
  std::int64_t step_{};
  WheelDrive drive_;
  bool imu_reset_{};
  PlanarState state_;
  std::array<Friction, kWheels> friction_{};  // below the wheels
  PlatformMotion motion_;                     // of the step
  PlatformReading reading_;
  std::optional<CapturedPose> captured_;
  PlatformTruth truth_;
};

}  // namespace mrroc::sim
