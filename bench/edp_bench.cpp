// Cost of one whole step of the effector driver, beside the inverse kinematics alone on the same path.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include "base/fault.hpp"
#include "bench/figures.hpp"
#include "bench/force_bench.hpp"
#include "bench/kinematics_bench.hpp"
#include "bench/round_trip.hpp"
#include "edp/driver.hpp"
#include "robots/irb6/arm.hpp"
#include "test/edp/guard_count.hpp"
#include "test/heap.hpp"
#include "test/sim/pose_goal.hpp"

namespace mrroc::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMacrosteps = 6000;
constexpr int kWarmUp = 200;  // macrosteps that are not measured
constexpr long kRoundTripPoses = 1'000'000;

double median(std::vector<double> x) {
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), middle, x.end());
  return *middle;
}

/// Time of one call [us].
template <class Function>
double timed_us(Function function) {
  const auto begin = Clock::now();
  function();
  return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
}

/// What reading the clock itself costs [us].
double clock_us() {
  std::vector<double> times(20'000);
  for (double& t : times) t = timed_us([] {});
  return median(times);
}

/// A driver of the real arm with drives that follow at once. It goes in circles and feels a noisy force.
class Rig {
 public:
  explicit Rig(const irb6::Arm& arm) : arm_(arm), driver_(arm, parameters(arm)) {
    motors_ = arm.motors_from_joints(arm.front());
    send({.instruction = Instruction::synchro});
    finish_macrostep();
  }

  /// Gives the command of the next macrostep: TCIM-VELOCITY, law (28) on all three linear axes.
  void command(int macrostep) {
    const double angle = 2 * M_PI * macrostep / 100;
    EffectorCommand c{.instruction = Instruction::set_get};
    c.set = static_cast<std::uint8_t>(Part::arm);
    c.get = static_cast<std::uint8_t>(Part::arm);
    c.arm.frame = {.x = g(0.02 * std::cos(angle), 20, 0.005),
                   .y = g(0.02 * std::sin(angle), 20, 0.005),
                   .z = mrroc::c(0, 20, 0.005),
                   .ax = u(0.02 * std::cos(angle)),
                   .ay = u(0.02 * std::sin(angle)),
                   .az = u(0.02 * std::cos(angle))};
    send(c);
  }

  /// Reads what the sensors say now.
  void measure() {
    ++reading_.step;
    for (int k = 0; k < arm_.axes(); ++k)
      reading_.encoder[static_cast<std::size_t>(k)] =
          static_cast<std::int32_t>(std::lround(motors_[k] * arm_.axis(k).increments_per_rad));
    reading_.S_F_m = {{noise(), noise(), noise(), 0, 0, 0}};
  }
  /// One step of the driver: what is measured.
  void step() noexcept { command_ = driver_.step(reading_); }
  /// The drives follow.
  void follow() { motors_ = driver_.set_point().axes.motors; }

  [[nodiscard]] const edp::Driver& driver() const { return driver_; }

  /// The driver of an arm that stands at its front pose.
  static edp::DriverParameters parameters(const irb6::Arm& arm) {
    edp::DriverParameters p;
    p.synchro_joints = arm.front();
    p.T_WE = arm.tool_in_wrist();
    p.force.T_WS = arm.sensor_in_wrist();
    p.supervision.torque_steps = std::numeric_limits<int>::max();  // the motors of this rig need no torque
    return p;
  }

 private:
  void send(EffectorCommand c) {
    c.session = 1;
    c.number = ++number_;
    driver_.take(c);
  }
  void finish_macrostep() {
    do {
      measure();
      step();
    } while (!driver_.at_boundary());
  }
  double noise() { return std::normal_distribution<>(0, 0.05)(random_); }

  const irb6::Arm& arm_;
  edp::Driver driver_;
  AxisVector motors_;
  HardwareReading reading_{};
  HardwareCommand command_{};
  std::int64_t number_{};
  std::mt19937_64 random_{1};
};

struct StepCost {
  double step_us{}, ik_us{};
  long allocations{};
};

/// Steps and inverse kinematics take turns, so that whatever else the machine does hits both.
StepCost measure_step() {
  const irb6::Arm arm(irb6::kPostument);
  Rig rig(arm);
  const Pose T_EW = arm.tool_in_wrist().inverse();
  std::vector<double> step_us, ik_us;
  step_us.reserve(kMacrosteps * 10);
  ik_us.reserve(kMacrosteps * 10);
  long allocations = 0;
  for (int i = 0; i < kMacrosteps + kWarmUp; ++i) {
    rig.command(i);
    do {
      rig.measure();
      const AxisVector near = rig.driver().set_point().axes.joints;
      double us = 0;
      {
        const mrroc::test::AllocationCounter heap;
        us = timed_us([&] { rig.step(); });
        allocations += heap.count();
      }
      const Pose T_0W = rig.driver().set_point().T_0E * T_EW;
      edp::InverseSolution solution;
      const double alone = timed_us([&] { solution = arm.inverse(T_0W, near); });
      if (!solution.reached)
        throw FaultError(FaultCode::internal_error, "the benchmark's path leaves the reach");
      rig.follow();
      if (i < kWarmUp) continue;
      step_us.push_back(us);
      ik_us.push_back(alone);
    } while (!rig.driver().at_boundary());
    if (rig.driver().state() != DriverState::executing)
      throw FaultError(FaultCode::internal_error, "the benchmark's driver does not move");
  }
  const double clock = clock_us();
  return {median(step_us) - clock, median(ik_us) - clock, allocations};
}

/// @return steps with a set point beyond a limit, both arms together
long set_point_violations(long steps) {
  long violations = 0;
  for (const irb6::ArmParameters& table : {irb6::kPostument, irb6::kTrack}) {
    const irb6::Arm arm(table);
    violations += edp::test::count_set_points(arm, Rig::parameters(arm), steps / 2, 1).violations;
  }
  return violations;
}

/// @throws FaultError internal_error: a motion has ended with a fault
Figures pose_goal_figures() {
  const sim::test::PoseGoalCount count = sim::test::count_pose_goals(1000, 1);
  if (count.faults > 0) throw FaultError(FaultCode::internal_error, "a pose was not reached: " + count.worst);
  return {{"pose_goal_err_mm", count.error_mm, "mm",
           "1,000 single commands with a pose, then silence: distance from it at rest, in the world"},
          {"pose_goal_err_deg", count.error_deg, "deg", "angle there"},
          {"pose_goal_overshoot_mm", count.overshoot_mm, "mm", "how far the arm was beyond the pose"}};
}

}  // namespace

Figures run_edp_group() {
  const StepCost cost = measure_step();
  const edp::test::InvalidCount invalid = edp::test::count_invalid(1'000'000, 1);
  auto ns = run_kinematics_benchmarks();
  const double ik = ns.at("inverse_kinematics/0");
  const RoundTrips trips = run_round_trips(kRoundTripPoses);
  Figures figures{
      {"edp_step_us_p50", cost.step_us, "us",
       "one step of the driver: force, law, frames, kinematics, regulators"},
      {"edp_step_vs_ik", cost.step_us / cost.ik_us, "",
       "the same over the inverse kinematics alone, same path"},
      {"edp_step_allocations", static_cast<double>(cost.allocations), "",
       "blocks from the heap in all steps"},
      {"ik_round_trip_fail", static_cast<double>(trips.failures), "",
       "all branches of 10^6 random poses: not reached, inexact, another branch, beyond limits"},
      {"ik_round_trip_err", trips.largest, "m, 1", "largest error of FK(IK(x)) there"},
      {"invalid_executed", static_cast<double>(invalid.executed + invalid.changed), "",
       "of 10^6 invalid commands, those executed or not without a trace"},
      {"setpoint_violations", static_cast<double>(set_point_violations(10'000'000)), "",
       "set points beyond a limit of speed or acceleration in 10^7 steps"},
      {"ik_ns", ik, "ns", "inverse kinematics, random poses, pedestal arm"},
      {"fk_ns", ns.at("direct_kinematics/0"), "ns", "direct kinematics"},
      {"ik_vs_kdl", ns.at("kdl_inverse_kinematics/0") / ik, "", "KDL's numeric solver over ours, same poses"},
  };
  std::ranges::move(pose_goal_figures(), std::back_inserter(figures));
  figures.push_back(stability_limit_figure());
  figures.push_back(sign_figure());
  std::ranges::move(run_force_figures(), std::back_inserter(figures));
  return figures;
}

}  // namespace mrroc::bench
