// What the kernels of Rex cost while its driver follows a figure eight on the simulated ground.
#include <algorithm>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/fault.hpp"
#include "bench/figures.hpp"
#include "bench/vision.hpp"
#include "edp/platform/driver.hpp"
#include "robots/rex/platform_type.hpp"
#include "robots/rex/rex.hpp"
#include "sim/platform/platform_world.hpp"
#include "tasks/rex_drive/plan/built_in_plans.hpp"
#include "tasks/rex_drive/plan/plan_file.hpp"
#include "tasks/rex_drive/planner/survey.hpp"

namespace mrroc::bench {
namespace {

constexpr std::int64_t kSession = 1;
constexpr int kMostMacrosteps = 3000;  // a minute; the way takes a third of it
constexpr double kWanted = 0.6;        // [m/s]

/// Computing times [ms], thread CPU.
struct Costs {
  std::vector<double> tracker;    ///< of its steps
  std::vector<double> estimator;  ///< of its steps with what was added before
  std::vector<double> driver;     ///< of macrosteps
};

/// Adds what the work takes. @return its result
template <class Work>
auto timed(double& ms, const Work& work) {
  const double begun = thread_ms();
  const auto result = work();
  ms += thread_ms() - begun;
  return result;
}

class TimedEstimator final : public edp::Estimator {
 public:
  TimedEstimator(std::unique_ptr<edp::Estimator> estimator, Costs& costs)
      : estimator_(std::move(estimator)), costs_(&costs) {}
  void begin(const edp::StandingStill& found) noexcept override { estimator_->begin(found); }
  void add(const edp::StageReading& reading) noexcept override {
    const double begun = thread_ms();
    estimator_->add(reading);
    ms_ += thread_ms() - begun;
  }
  bool add(const OdometryReading& odometry) noexcept override {
    return timed(ms_, [&] { return estimator_->add(odometry); });
  }
  bool add(const MapPose& pose) noexcept override {
    return timed(ms_, [&] { return estimator_->add(pose); });
  }
  edp::EstimatorResult step() noexcept override {
    const edp::EstimatorResult result = timed(ms_, [&] { return estimator_->step(); });
    costs_->estimator.push_back(std::exchange(ms_, 0));
    return result;
  }

 private:
  std::unique_ptr<edp::Estimator> estimator_;
  Costs* costs_;
  double ms_{};  // since the last step
};

class TimedTracker final : public edp::Tracker {
 public:
  TimedTracker(std::unique_ptr<edp::Tracker> tracker, Costs& costs)
      : tracker_(std::move(tracker)), costs_(&costs) {}
  void begin(const edp::EstimatorResult& x) noexcept override { tracker_->begin(x); }
  edp::TrackerResult step(const edp::EstimatorResult& x, const Slip& slip, const PerWheel& load,
                          std::span<const PathPoint, kHorizonPoints> reference) noexcept override {
    double ms = 0;
    const edp::TrackerResult result = timed(ms, [&] { return tracker_->step(x, slip, load, reference); });
    costs_->tracker.push_back(ms);
    return result;
  }

 private:
  std::unique_ptr<edp::Tracker> tracker_;
  Costs* costs_;
};

/// Rex, whose kernels tell their computing times.
class TimedRex final : public edp::Platform {
 public:
  explicit TimedRex(Costs& costs) : costs_(&costs) {}
  [[nodiscard]] const edp::PlatformProperties& properties() const noexcept override {
    return rex::platform().properties();
  }
  [[nodiscard]] std::span<const std::string_view> estimators() const noexcept override {
    return rex::platform().estimators();
  }
  [[nodiscard]] std::span<const std::string_view> trackers() const noexcept override {
    return rex::platform().trackers();
  }
  [[nodiscard]] std::unique_ptr<edp::Estimator> estimator(std::string_view kind) const override {
    return std::make_unique<TimedEstimator>(rex::platform().estimator(kind), *costs_);
  }
  [[nodiscard]] std::unique_ptr<edp::Tracker> tracker(std::string_view kind) const override {
    return std::make_unique<TimedTracker>(rex::platform().tracker(kind), *costs_);
  }

 private:
  Costs* costs_;
};

/// @return one lap of the figure eight
rex_drive::PlanList lap() {
  rex_drive::PlanList list = rex_drive::built_in_plan("figure_eight");
  list.plans.resize(1);
  return list;
}

sim::PlatformWorldParameters ground() {
  sim::PlatformWorldParameters p;
  p.platforms.emplace_back().body = rex::type().plant;
  p.platforms.front().start = lap().start;
  p.room = {.lower = {-10, -10}, .upper = {10, 10}, .obstacles = {}};
  return p;
}

/// Driver and platform, macrostep after macrostep.
class Drive {
 public:
  explicit Drive(Costs& costs)
      : costs_(&costs),
        rex_(costs),
        driver_(rex_, {.estimator = "mhe", .tracker = "nmpc"}),
        world_(ground()) {}

  /// SYNCHRO. @throws FaultError internal_error: it has not ended well
  void synchronise() {
    macrostep(numbered(Instruction::synchro));
    for (int k = 0; driver_.state() != DriverState::ready; ++k) go_on(k);
  }
  /// Drives one lap to its end. @throws FaultError internal_error: it does not arrive
  void figure_eight() {
    const auto plans = rex_drive::to_messages(lap(), kWanted);
    const auto way = rex_drive::survey(plans, driver_.estimate().estimate.p, {});
    if (way.missed) fail();
    for (const rex_drive::FoundTrajectory& piece : way.found) {
      for (int k = 0; driver_.reply().notified < driver_.reply().accepted; ++k) go_on(k);
      hand_over(piece.trajectory);
    }
    for (int k = 0; driver_.state() == DriverState::executing; ++k) go_on(k);
  }

 private:
  PlatformCommand message() {
    return {.session = kSession,
            .number = number_,
            .macrostep = world_.steps() / kPlatformSteps + 1,
            .map = map_};
  }
  PlatformCommand numbered(Instruction instruction) {
    ++number_;
    PlatformCommand c = message();
    c.instruction = instruction;
    return c;
  }
  void hand_over(const rex_drive::Trajectory& piece) {
    PlatformCommand c = numbered(Instruction::set);
    c.fragment = {.number = driver_.reply().accepted + 1,
                  .steps = rex_drive::traj_to_steps(piece),
                  .notify = rex_drive::traj_to_notify(piece, rex_drive::PlannerParameters{}.lead),
                  .knot = piece.knot};
    macrostep(c);
    if (driver_.reply().verdict != Verdict::executed) fail();
  }
  /// @param waited  macrosteps so far
  void go_on(int waited) {
    if (waited > kMostMacrosteps || driver_.state() == DriverState::faulted) fail();
    macrostep(message());
  }
  void macrostep(const PlatformCommand& command) {
    driver_.take(command);
    double ms = 0;
    do {
      const PlatformDrive drive = timed(ms, [&] { return driver_.step(world_.reading(0)); });
      world_.step({&drive, 1});
      if (const auto& seen = world_.motion_capture(0); seen && seen->reading.seen) see(seen->reading);
    } while (!driver_.at_boundary());
    costs_->driver.push_back(ms);
  }
  void see(const MotionCapture& reading) {
    map_ = {reading.step, true, reading.p, {2.5e-5, 0, 0, 0, 2.5e-5, 0, 0, 0, 1e-4}};
  }
  [[noreturn]] void fail() const {
    throw FaultError(FaultCode::internal_error, "the driver of Rex does not follow the figure eight: " +
                                                    std::string(driver_.reply().fault.text.view()));
  }

  Costs* costs_;
  TimedRex rex_;
  edp::PlatformDriver driver_;
  sim::PlatformWorld world_;
  MapPose map_;
  std::int64_t number_{};
};

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

}  // namespace

Figures rex_kernel_figures() {
  Costs costs;
  Drive drive(costs);
  drive.synchronise();
  costs = {};
  drive.figure_eight();
  return {{"nmpc_cpu_ms_mean", mean(costs.tracker), "ms",
           "computing time of a step of the NMPC, mean, wanted <= 0.5"},
          {"mhe_cpu_ms_mean", mean(costs.estimator), "ms",
           "computing time of a step of the MHE, mean, wanted <= 1.2"},
          {"iteration_cpu_ms_max", std::ranges::max(costs.driver), "ms",
           "computing time of the driver in a macrostep, largest, wanted <= 5"}};
}

}  // namespace mrroc::bench
