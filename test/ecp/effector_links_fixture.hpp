// An arm's links with the test as driver, coordinator, sensor and supervisor.
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "base/link/memory_bus.hpp"
#include "base/msg/convert.hpp"
#include "ecp/effector_links.hpp"
#include "test/base/link/one_by_one_bus.hpp"

namespace mrroc::ecp::test {

using link::Phase;

/// The agent's process in this thread; the test speaks for driver, coordinator, sensor and supervisor.
class ArmLinksTest : public testing::Test {
 protected:
  void begin(ClockKind clock, const EffectorLinkNames& names = {.robot = "arm1", .sensor = "arm1.sensor"},
             std::chrono::milliseconds timeout = std::chrono::seconds(20)) {
    links.reset();
    process.reset();
    own.reset();
    own = std::make_unique<link::test::OneByOneBus>(hub.open());
    others = hub.open();
    link::NodeContext m;
    m.session = "links";
    m.name = name_;
    m.roster = {"mp", name_};
    m.clock = clock;
    m.timeout = timeout;
    process.emplace(*own, m);
    links.emplace(*process, names);
    replies.emplace(*others, process->route("arm1.reply"), 1);
    orders.emplace(*others, process->route("arm1.order"), 1);
    readings.emplace(*others, process->route("arm1.sensor"), 1);
    supervisor.emplace(*others, process->route("supervisor"), 1);
    commands.emplace(*others, process->route("arm1.command"), 1);
    reports.emplace(*others, process->route("arm1.report"), 1);
    say(Phase::running);
  }
  void say(Phase phase, std::int64_t as_of = 0) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    m.as_of = as_of;
    supervisor->publish(m, 0);
  }
  /// @return a reply that tells its macrostep by the distance of the jaws
  static EffectorReply told(std::int64_t i) {
    EffectorReply r;
    r.gripper = static_cast<double>(i);
    return r;
  }
  void reply(std::int64_t i) { reply(i, told(i)); }
  void reply(std::int64_t i, const EffectorReply& r) { replies->publish(to_message(r), i); }
  void order(std::int64_t i) { orders->publish(to_message(Order{.m = static_cast<int>(i)}), i); }
  void read(std::int64_t i) { readings->publish(to_message(SensorReading{.state = static_cast<int>(i)}), i); }
  void all(std::int64_t i) {
    reply(i);
    order(i);
    read(i);
  }
  /// @return the oldest command that has not been looked at
  effector_command_t sent() {
    while (others->wait(std::chrono::milliseconds(0))) {
    }
    return commands->take().value_or(effector_command_t{});
  }

  std::string name_ = "ecp-arm1";
  link::MemoryHub hub;
  std::unique_ptr<link::Bus> own, others;
  std::optional<link::Process> process;
  std::optional<ArmLinks> links;
  std::optional<link::Outbox<effector_reply_t>> replies;
  std::optional<link::Outbox<agent_order_t>> orders;
  std::optional<link::Outbox<sensor_reading_t>> readings;
  std::optional<link::Outbox<supervisor_t>> supervisor;
  std::optional<link::Queue<effector_command_t>> commands;
  std::optional<link::Queue<agent_report_t>> reports;
};

}  // namespace mrroc::ecp::test
