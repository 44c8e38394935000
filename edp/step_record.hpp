// What is recorded of a step of an arm's driver.
#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "base/axes.hpp"
#include "base/hardware.hpp"
#include "edp/driver.hpp"
#include "edp/recorder.hpp"

namespace mrroc::edp {

/// Everything about one step. Trivially copyable.
struct StepRecord {
  std::int64_t step{};                           ///< of the driver
  DriverState state{};                           ///< after the step
  FaultCode fault{};                             ///< that stood after the step
  std::array<double, kMaxAxes> set_motor{};      ///< [rad]
  std::array<std::int32_t, kMaxAxes> encoder{};  ///< [increments] since power-up
  std::array<double, kMaxAxes> current{};        ///< [A]
  std::array<double, kMaxAxes> pwm{};            ///< [1/255 of the supply]
  std::array<double, 3> set_position{};          ///< of E in the base [m]
  std::array<double, 3> position{};              ///< measured [m]
  Wrench F_a{};                                  ///< in E [N, N m]
  Wrench S_F_m{};                                ///< raw reading of the sensor, in S [N, N m]
};

/// @return what the driver has made of a reading; call it after the step. Real-time safe
[[nodiscard]] StepRecord record_of(const Driver& driver, const HardwareReading& reading,
                                   const HardwareCommand& command) noexcept;

/// The columns of such a record.
class StepFormat {
 public:
  using Record = StepRecord;  ///< of a step

  /// @param axes  how many motors have columns
  explicit(false) StepFormat(int axes) : axes_(axes) {}

  /// @return `step,t,state,fault,set_m1..,enc1..,current1..,pwm1..,set_x,set_y,set_z,x,y,z,Fx..Nz,raw_Fx..raw_Nz`
  [[nodiscard]] std::string header() const;
  /// Adds a line. @param dt  duration of a step [s]
  void append(std::string& text, const StepRecord& record, double dt) const;

 private:
  int axes_;
};

/// Those of an arm's driver.
using Recorder = BasicRecorder<StepRecord>;
using RecordFiles = BasicRecordFiles<StepFormat>;

}  // namespace mrroc::edp
