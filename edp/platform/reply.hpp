// Makes the reply of a platform's driver, and what it tells of its thoughts.
#pragma once
#include <cstdint>

#include "base/platform_command.hpp"
#include "edp/platform/follower.hpp"
#include "edp/platform/fragment_queue.hpp"
#include "edp/platform/observer.hpp"
#include "edp/platform/reference.hpp"
#include "edp/protocol.hpp"

namespace mrroc::edp {

/// Result of the command of a macrostep.
struct PlatformAnswer {
  std::int64_t session{};          ///< of the command; 0: there was none
  std::int64_t number{};           ///< of the command
  Verdict verdict{Verdict::none};  ///< on it
  Fault fault{};                   ///< why it was refused
  bool replay{};                   ///< session, number, verdict and fault of the stored reply are the answer
  bool store{};                    ///< the reply is to be stored
};

/// State of a driver, for its reply. References are valid while a reply is built.
struct PlatformView {
  std::int64_t step;           ///< of the last reading
  DriverState state;           ///< of the automaton
  const Fault& fault;          ///< that stands, fatal or not yet told; code none: there is none
  bool position_known;         ///< the platform's
  bool at_rest;                ///< the platform
  bool follows;                ///< the tracker drives it
  const FragmentQueue& queue;  ///< fragments that it has taken and not yet finished
  const Observer& observer;    ///< its estimate
  const Follower& follower;    ///< its tracker
  const Reference& reference;  ///< where it is to be
  const PerWheel& torque;      ///< commanded [N m]
  const PerWheel& load;        ///< of the wheels, as the kernels use them [N]
};

/// @return the reply; its macrostep is 0: the shell stamps it. Real-time safe
[[nodiscard]] PlatformReply build_reply(const PlatformView& driver, const PlatformAnswer& answer,
                                        const BasicProtocol<PlatformEffector>& protocol) noexcept;

/// @return reference and horizon; without a tracker at work the platform expects to stay. Real-time safe
[[nodiscard]] PlatformTelemetry build_telemetry(const PlatformView& driver) noexcept;

}  // namespace mrroc::edp
