// The links of an embodied agent: to its effector driver, its virtual sensor and the coordinator.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "base/effector.hpp"
#include "base/link/process.hpp"
#include "base/link/transmission_link.hpp"
#include "base/motion.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/convert_platform.hpp"
#include "base/transmission.hpp"
#include "ecp/effector_client.hpp"
#include "mrroc/agent_order_t.hpp"
#include "mrroc/agent_report_t.hpp"
#include "mrroc/sensor_reading_t.hpp"

namespace mrroc::ecp {

/// Names of an agent's links.
struct EffectorLinkNames {
  std::string robot;  ///< channels ROBOT.command, .reply, .order, .report
  std::string
      sensor;  ///< channel of the virtual sensor's readings, SENSOR; its settings go to SENSOR.setting. Empty: the
               ///< agent has none
  link::OtherLinks others{};  ///< waited for as these are, also while the agent is paused
};

/// Sends y and receives x once per macrostep. In lock-step every message of macrostep i is waited for (rule
/// R1). With the wall clock the driver's newest reply sets the pace: i goes on to its macrostep, what is passed
/// over is counted as skipped. A reading or order that is not there for that macrostep is taken as it was; such an
/// order is marked as late.
template <Effector E>
class EffectorLinks {
 public:
  using Command = typename E::Command;  ///< y_ce
  using Reply = typename E::Reply;      ///< x_ce

  /// Make this before the process assembles. @param process  must outlive the links
  EffectorLinks(link::Process& process, const EffectorLinkNames& names);

  /// Assembles with the others, publishes the defined messages of macrostep 1 and receives the first images.
  /// @return aborted when the system ends before
  Outcome begin();

  /// Says which behaviour decides on what is sent from now on.
  void in_behaviour(int m, std::string_view name, std::string_view until) {
    process_.in_behaviour(m, name, until);
  }

  /// y_cV for the virtual sensor, from the next send() on; zeros before.
  void set_sensor(const SensorSetting& setting);
  /// Sends what is for macrostep i + 1: these, the sensor's setting and the typed links.
  void send(const Command& command, const Report& report);

  /// Releases the effector, and says on the typed links that nothing more will come.
  void end();

  /// i := i + 1, receives the images of the new macrostep.
  /// @return aborted when the system stops, faulted when the driver does not take commands any more
  /// @throws FaultError peer_silent, malformed_message: what must come does not, see
  ///         link::Process::await_from(); malformed_message: a number is not proper
  Outcome wait();

  /// @return macrostep of the images, from 1 on
  [[nodiscard]] std::int64_t i() const { return i_; }
  /// @return x_ce of macrostep i
  [[nodiscard]] const Reply& reply() const { return reply_; }
  /// @return x_cV; zeros without a sensor
  [[nodiscard]] const SensorReading& reading() const { return reading_; }
  /// @return x_cT, the coordinator's order
  [[nodiscard]] const Order& order() const { return order_; }
  /// @return why wait() gave faulted
  [[nodiscard]] const BasicEffectorClient<E>& client() const { return client_; }

 private:
  using CommandMessage = link::MessageOf<Command>;
  using ReplyMessage = link::MessageOf<Reply>;

  Outcome receive();
  void go_on_to_newest();

  link::Process& process_;
  bool has_sensor_;
  std::unique_ptr<link::Outbox<CommandMessage>> command_out_;
  std::unique_ptr<link::Outbox<agent_report_t>> report_out_;
  std::unique_ptr<link::OutgoingLink<SensorSetting>> setting_out_;  // null: the agent has no sensor
  std::unique_ptr<link::Inbox<ReplyMessage>> reply_in_;
  std::unique_ptr<link::Inbox<sensor_reading_t>> reading_in_;
  std::unique_ptr<link::Inbox<agent_order_t>> order_in_;
  link::Sources sources_;
  link::OtherLinks others_;
  BasicEffectorClient<E> client_;
  std::int64_t i_{};
  Reply reply_;
  SensorReading reading_;
  Order order_;
};

/// The links of an arm's agent.
using ArmLinks = EffectorLinks<ArmEffector>;
/// The links of a platform's agent.
using PlatformLinks = EffectorLinks<PlatformEffector>;

}  // namespace mrroc::ecp
