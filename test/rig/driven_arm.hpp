// One arm of the simulator with its real effector driver, in lock-step and in one process: for tests and
// benchmarks of control subsystems, which run on it as they run over the links.
#pragma once
#include <memory>

#include "base/motion.hpp"
#include "ecp/effector_client.hpp"
#include "edp/driver.hpp"
#include "robots/irb6/arm.hpp"
#include "sim/world.hpp"

namespace mrroc::rig {

/// The arm, its driver and the latencies of the links: what is commanded in macrostep i is executed in i + 1,
/// and its answer is read in i + 2.
class DrivenArm {
 public:
  /// Synchronises the driver and lets the arm come to rest.
  /// @param arm   of a world with this arm alone
  /// @throws FaultError  what the driver has refused
  DrivenArm(const sim::ArmParameters& arm, std::uint64_t seed);

  /// Sends y_ce of macrostep i + 1.
  void send(const EffectorCommand& command) { next_ = command; }
  /// i := i + 1.
  /// @return faulted when a command was refused or failed
  Outcome wait();

  /// @return macrostep of reply()
  [[nodiscard]] std::int64_t i() const { return i_; }
  /// @return x_ce of macrostep i
  [[nodiscard]] const EffectorReply& reply() const { return reply_; }
  /// @return why wait() gave faulted
  [[nodiscard]] const Fault& fault() const { return reply_.fault; }
  /// @return the robot that the driver works with
  [[nodiscard]] const irb6::Arm& robot() const { return *robot_; }
  /// @return the real driver
  [[nodiscard]] const edp::Driver& driver() const { return *driver_; }
  /// @return what is true of the arm after the last step
  [[nodiscard]] const sim::ArmTruth& truth() const { return world_.truth(0); }

 private:
  std::unique_ptr<irb6::Arm> robot_;
  sim::World world_;
  std::unique_ptr<edp::Driver> driver_;
  ecp::EffectorClient client_{1};
  EffectorCommand next_, current_;
  EffectorReply reply_;
  std::int64_t i_{};
};

/// Port of an agent (base/motion.hpp) whose images are those of ArmAgent.
template <Images A>
class DrivenPort {
 public:
  /// @param arm  must outlive the port
  explicit DrivenPort(DrivenArm& arm) : arm_(arm) {}
  /// The operations of a Port: sends y.e; i := i + 1; fills in e and i of x.
  void dispatch(const Motion<A>&, const typename A::Y& y) { arm_.send(y.e); }
  Outcome wait() { return arm_.wait(); }
  void read(typename A::X& x) const {
    x.e = arm_.reply();
    x.i = arm_.i();
  }

 private:
  DrivenArm& arm_;
};

}  // namespace mrroc::rig
