// What the shell wants of an effector driver of any kind.
#pragma once
#include <concepts>
#include <cstdint>

#include "base/effector.hpp"

namespace mrroc::edp {

/// An effector driver without any input or output, called once per step, as Driver of an arm is: its members mean the same.
///
///     if (driver.at_boundary() && there is a command for this macrostep) driver.take(command);
///     send(driver.step(reading));
///     if (driver.reply_due()) publish(driver.reply());
///
/// @tparam E  kind of its effector
template <class D, class E>
concept SteppedDriver = Effector<E> &&
    requires(D d, const D& told, const typename E::Command& command, const typename E::Reading& reading,
             const Fault& fault, std::int64_t session) {
  d.take(command);
  { d.step(reading) } -> std::same_as<typename E::Drive>;
  d.trip(fault);
  d.drop_owner();
  { told.at_boundary() } -> std::same_as<bool>;
  { told.macrostep_steps() } -> std::same_as<int>;
  { told.reply_due() } -> std::same_as<bool>;
  { told.reply() } -> std::same_as<const typename E::Reply&>;
  { told.state() } -> std::same_as<DriverState>;
  { told.standstill().at_rest() } -> std::same_as<bool>;
  { told.standstill().stop_steps(std::int64_t{}) } -> std::same_as<int>;
  { told.fault() } -> std::same_as<const Fault&>;
  { told.owned_by_another(session) } -> std::same_as<bool>;
  { told.protocol().repeated() } -> std::same_as<std::int64_t>;
  { told.protocol().lost() } -> std::same_as<std::int64_t>;
};

}  // namespace mrroc::edp
