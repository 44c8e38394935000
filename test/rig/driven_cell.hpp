// The arms of a world with their real effector drivers, in lock-step and in one process: for tests and benchmarks of
// tasks of several arms, which run on them as they run over the links.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "base/motion.hpp"
#include "ecp/effector_client.hpp"
#include "edp/driver.hpp"
#include "robots/irb6/arm.hpp"
#include "sim/world.hpp"

namespace mrroc::rig {

/// @return parameters of the driver of an arm as it stands in a world: its tool, sensor, start joints and jaws
edp::DriverParameters driver_parameters(const irb6::Arm& robot, const sim::ArmParameters& arm,
                                        const AxisVector& start);

/// All arms, their drivers and the latencies of the links: what is commanded in macrostep i is executed in i + 1, and
/// its answer is read in i + 2. Macrosteps have 10 steps.
class DrivenCell {
 public:
  /// Synchronises the drivers and lets the arms come to rest.
  /// @param limits  of the drivers, by arm; a driver without has the defaults
  /// @param oscillation  what all drivers call an unstable contact
  /// @throws FaultError  what a driver has refused
  DrivenCell(const sim::WorldParameters& world, std::uint64_t seed,
             const std::vector<edp::Limits>& limits = {}, const edp::OscillationParameters& oscillation = {});

  /// Sends y_ce of macrostep i + 1; an arm to which nothing is sent comes to rest.
  void send(int arm, const EffectorCommand& command) { arms_[index(arm)].next = command; }
  /// i := i + 1. @return faulted when a command of an arm was refused or failed
  Outcome wait();
  /// Calls after every step of the simulator.
  void watch(std::function<void()> after) { after_ = std::move(after); }

  /// @return macrostep of reply()
  [[nodiscard]] std::int64_t i() const { return i_; }
  /// @return x_ce of macrostep i
  [[nodiscard]] const EffectorReply& reply(int arm) const { return arms_[index(arm)].reply; }
  /// @return the robot that its driver works with
  [[nodiscard]] const irb6::Arm& robot(int arm) const { return *arms_[index(arm)].robot; }
  /// @return the real driver of the arm
  [[nodiscard]] const edp::Driver& driver(int arm) const { return *arms_[index(arm)].driver; }
  /// @return the world in which they stand
  [[nodiscard]] sim::World& world() { return world_; }
  [[nodiscard]] const sim::World& world() const { return world_; }

 private:
  struct Driven {
    std::unique_ptr<irb6::Arm> robot;
    std::unique_ptr<edp::Driver> driver;
    ecp::EffectorClient client{1};
    EffectorCommand next, current;
    EffectorReply reply;
  };
  static std::size_t index(int arm) { return static_cast<std::size_t>(arm); }

  sim::World world_;
  std::vector<Driven> arms_;
  std::function<void()> after_;
  std::int64_t i_{};
};

}  // namespace mrroc::rig
