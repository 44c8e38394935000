// The reader of an effector driver: keeps the last steps and writes them down after a fault.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "base/axes.hpp"
#include "base/hardware.hpp"
#include "edp/driver.hpp"

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

/// The newest steps, in a ring that is as long as it was made.
class Recorder {
 public:
  /// @param capacity  steps, at least 1
  explicit Recorder(std::size_t capacity);

  /// Real-time safe.
  void add(const StepRecord& record) noexcept;

  /// @return number of steps it holds
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// @param k  0: the oldest, below size()
  [[nodiscard]] const StepRecord& operator[](std::size_t k) const noexcept;
  /// Holds nothing any more. Real-time safe.
  void clear() noexcept { size_ = 0; }

 private:
  std::vector<StepRecord> ring_;
  std::size_t next_{};
  std::size_t size_{};
};

/// @param axes  how many motors have columns
/// @return `step,t,state,fault,set_m1..,enc1..,current1..,pwm1..,set_x,set_y,set_z,x,y,z,Fx..Nz,raw_Fx..raw_Nz`
[[nodiscard]] std::string record_header(int axes);
/// @param dt  duration of a step [s]
/// @return one line per step, without the header; what is not finite is `nan`
[[nodiscard]] std::string record_lines(const Recorder& recorder, int axes, double dt);

/// When the steps of an arm are written down.
enum class Recording : std::uint8_t {
  never,
  on_fault,  ///< the last kBefore steps and kAfter more, once per fault, kMostFiles times
  always     ///< all of them
};

/// Writes the steps of one arm into files. The steps before a fault are many: a thread writes them, so that the
/// driver goes on meanwhile.
class RecordFiles {
 public:
  static constexpr std::size_t kBefore = 2500;  ///< steps
  static constexpr int kAfter = 50;             ///< steps
  static constexpr int kMostFiles = 5;          ///< of faults, in a run

  /// @param folder  where ROBOT-steps.csv (always) or ROBOT-fault-STEP.csv go
  RecordFiles(Recording when, std::filesystem::path folder, std::string robot, int axes, double dt);
  /// Writes what a fault has begun, and waits for it.
  ~RecordFiles();
  RecordFiles(const RecordFiles&) = delete;
  RecordFiles& operator=(const RecordFiles&) = delete;

  /// After every step. Real-time safe.
  void add(const StepRecord& record) noexcept;
  /// When no more steps come because of a fault elsewhere: writes those there are, unless a file has them already. Not
  /// real-time safe.
  void dump_on_abort();
  /// Begins a file as a fault does, unless one was begun a moment ago: something has happened elsewhere. Real-time safe.
  void trigger() noexcept;
  /// Once per macrostep: writes what there is to be written. What cannot be written is left out: a driver does not end
  /// for it. Not real-time safe.
  /// @return the file that a fault has got, or empty
  std::filesystem::path write();

 private:
  std::filesystem::path write_fault();

  Recording when_;
  std::filesystem::path folder_;
  std::string robot_;
  int axes_;
  double dt_;
  Recorder recorder_;
  FaultCode last_fault_{FaultCode::none};
  std::int64_t fault_step_{-1};                                 // of the fault that is being recorded
  int after_{};                                                 // steps since
  bool triggered_{};                                            // the next step begins a file
  std::int64_t recorded_{-static_cast<std::int64_t>(kBefore)};  // step of the last file
  int files_{};
  bool begun_{};  // ROBOT-steps.csv has its header
  std::jthread writer_;
};

}  // namespace mrroc::edp
