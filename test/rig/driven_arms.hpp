// The coordinator's port in a cell of driven arms: both arms' agents and drivers in one thread, as they run over the links.
#pragma once
#include <array>
#include <functional>

#include "base/fault.hpp"
#include "tasks/rubik/coordinator.hpp"
#include "tasks/rubik/turn/stepped_arm.hpp"
#include "test/rig/driven_cell.hpp"

namespace mrroc::rig {

/// A rubik::Program runs on it.
class DrivenArms {
 public:
  using Coordinator = rubik::Coordinator;  ///< whose images these are

  /// @param cell  outlives this object
  /// @param limits  of free motions, by arm: of the motors
  /// @param end  step of the simulator in which the wait is aborted
  /// @param watch  called in every macrostep with the coordinator's behaviour
  DrivenArms(DrivenCell& cell, const std::array<ecp::MotionLimits, rubik::kArms>& limits, std::int64_t end,
             std::function<void(int m)> watch)
      : cell_(cell), end_(end), watch_(std::move(watch)) {
    for (std::size_t arm = 0; arm < rubik::kArms; ++arm) x_[arm].c.limits = limits[arm];
  }

  /// What the arms read in the macrostep that begins with wait().
  void dispatch(const Motion<Coordinator>& motion, const Coordinator::Y& y);
  /// Both arms decide, and the cell goes on. @return faulted: an arm did, see fault(); aborted: time is over
  Outcome wait();
  /// Fills in T and i of x.
  void read(Coordinator::X& x);

  /// @return why an arm stopped
  [[nodiscard]] const Fault& fault() const { return fault_; }

 private:
  DrivenCell& cell_;
  std::int64_t end_;
  std::function<void(int m)> watch_;
  int m_{};
  std::array<rubik::SteppedArm, rubik::kArms> agents_;
  std::array<rubik::Arm::X, rubik::kArms> x_;
  std::array<rubik::ArmReport, rubik::kArms> reports_;
  Fault fault_;
};

}  // namespace mrroc::rig
