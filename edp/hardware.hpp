// The interface between an effector driver and its robot: drives and sensors, once per step.
#pragma once
#include <concepts>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "base/effector.hpp"
#include "edp/period_clock.hpp"

namespace mrroc::edp {

/// Result of reading the hardware.
enum class ReadStatus : std::uint8_t {
  reading,  ///< ReadResult::reading is new
  silent,   ///< by the wall clock: the time of a step has passed without a reading
  ended,    ///< no reading will ever come again
};

/// Input of a step.
template <Effector E>
struct BasicReadResult {
  ReadStatus status{ReadStatus::silent};  ///< of the three, which
  typename E::Reading reading{};          ///< only with ReadStatus::reading
  /// In lock-step: macrosteps that the drivers of all robots have begun. What they have not begun, no coordinator knows of:
  /// a command that depends on it cannot come.
  std::int64_t begun{std::numeric_limits<std::int64_t>::max()};
};
/// That of an arm.
using ReadResult = BasicReadResult<ArmEffector>;

/// The drives and sensors of one robot. The implementation says whose clock it is: read() returns when the step begins.
///
/// read(step): the reading of that step. In lock-step it waits until that reading has come. By the wall clock it waits
/// for the time of one step at most, and gives the newest reading, whose number is larger than `step` when steps were
/// missed. It may throw FaultError when what it waits for will not come.
///
/// write(command): set values for the step of the last reading; called once after each reading.
///
/// A hardware whose clock is the driver's own may have a member clock() that gives its PeriodClock: then the driver tells
/// at its end how late its periods were, and trips with host_too_slow when the host cannot keep to them.
/// @tparam E  kind of the robot
template <class H, class E = ArmEffector>
concept Hardware = Effector<E> && requires(H h, const typename E::Drive& command, std::int64_t step) {
  { h.read(step) } -> std::same_as<BasicReadResult<E>>;
  { h.write(command) } -> std::same_as<void>;
};

/// Owns the hardware of any kind: a driver's program learns only when it starts which one it is. The driver's side
/// allocates nothing after its construction.
template <Effector E>
class BasicAnyHardware {
 public:
  using Drive = typename E::Drive;  ///< set values

  /// @param hardware  is moved here
  template <Hardware<E> H>
  requires(!std::same_as<H, BasicAnyHardware>) explicit(false) BasicAnyHardware(H hardware)
      : held_(std::make_unique<Held<H>>(std::move(hardware))) {}

  /// As the concept has it.
  BasicReadResult<E> read(std::int64_t step) { return held_->read(step); }
  /// As the concept has it.
  void write(const Drive& command) { held_->write(command); }
  /// @return the clock of a hardware that has one of its own; else null
  [[nodiscard]] const PeriodClock* clock() const { return held_->clock(); }

 private:
  struct Interface {
    virtual ~Interface() = default;
    virtual BasicReadResult<E> read(std::int64_t step) = 0;
    virtual void write(const Drive& command) = 0;
    [[nodiscard]] virtual const PeriodClock* clock() const = 0;
  };
  template <class H>
  struct Held final : Interface {
    explicit Held(H h) : hardware(std::move(h)) {}
    BasicReadResult<E> read(std::int64_t step) override { return hardware.read(step); }
    void write(const Drive& command) override { hardware.write(command); }
    [[nodiscard]] const PeriodClock* clock() const override {
      if constexpr (requires { hardware.clock(); })
        return hardware.clock();
      else
        return nullptr;
    }
    H hardware;
  };
  std::unique_ptr<Interface> held_;
};

/// The hardware of an arm.
using AnyHardware = BasicAnyHardware<ArmEffector>;
/// The hardware of a platform.
using AnyPlatformHardware = BasicAnyHardware<PlatformEffector>;

}  // namespace mrroc::edp
