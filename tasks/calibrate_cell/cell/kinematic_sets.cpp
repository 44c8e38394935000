#include "tasks/calibrate_cell/cell/kinematic_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "robots/catalogue.hpp"
#include "tasks/calibrate_cell/calibrate_cell.hpp"

namespace mrroc::calibrate_cell {
namespace {

/// Of the next best misfit over the best: four times the variance, which chance makes of some forty numbers once in 50,000 times.
constexpr double kClearly = 2;

/// An arm as its driver measures, with any of its sets.
class Measuring {
 public:
  Measuring(const Config& config, std::size_t arm) : type_(&arm_type(config, arm)) {
    const std::string key = kKeys.at(arm);
    const auto start =
        config.section("robots." + key).list("start_joints", std::vector<double>{}, {-10, 10}, "rad, m");
    robots::DriverSetup setup = robots::read_driver(config, key, *type_, start);
    robot_ = std::move(setup.robot);
    T_WE_ = setup.driver.T_WE;
    if (setup.driver.synchronisation == edp::Synchronisation::known_pose)
      synchro_ = setup.driver.synchro_joints;
    near_ = joints(start);
    views_ = read_views(config, key);
  }

  [[nodiscard]] int sets() const { return std::max(1, static_cast<int>(type_->parameter_sets.size())); }
  [[nodiscard]] int believed() const { return robot_->model() % sets(); }
  [[nodiscard]] std::string name(int set) const {
    return sets() < 2 ? "" : std::string(type_->parameter_sets[static_cast<std::size_t>(set)]);
  }

  /// @return the trace as the driver would have measured it with that set, rows of touches and pictures alone
  [[nodiscard]] mp::ArmTrace measured_with(const mp::ArmTrace& trace, int set) const {
    if (set == believed()) return trace;
    const auto other = type_->make(robot_->model() - believed() + set);
    mp::ArmTrace now = trace;
    AxisVector near = near_;
    std::size_t view = 0;
    int before = 0;
    for (mp::ArmRow& row : now) {
      if (row.m == kWaitToView && !views_.empty()) near = joints(views_.front().from);
      if (row.m == kLook && before != kLook) near = view_joints(view++).value_or(near);
      if (row.m == kGetReady) near = near_;
      before = row.m;
      if (row.m == kMeasure || row.m == kWaitToView || row.m == kLook || row.m == kKeepStill)
        row.pose = angle_axis_from_pose(with(*other, pose_from_angle_axis(row.pose), near));
    }
    return now;
  }

 private:
  static AxisVector joints(const std::vector<double>& q) {
    return Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
  }
  /// @return those planned for that picture, which choose the branch and where a track is
  [[nodiscard]] std::optional<AxisVector> view_joints(std::size_t number) const {
    for (const Views& views : views_) {
      if (number < views.joints.size()) return joints(views.joints[number]);
      number -= views.joints.size();
    }
    return {};
  }
  static const robots::RobotType& arm_type(const Config& config, std::size_t arm) {
    return robots::read_type(config, kKeys.at(arm), robots::catalogue(), kModels.at(arm));
  }

  /// @param near  joints of the pose before, then of this one
  [[nodiscard]] Pose with(const edp::Robot& other, const Pose& T_0E, AxisVector& near) const {
    near = robot_->inverse(T_0E * T_WE_.inverse(), near).joints;
    AxisVector motors = robot_->motors_from_joints(near);
    // Joints that SYNCHRO is told are the arm's own: the drivers of both sets count from there.
    if (synchro_.size() > 0)
      motors += other.motors_from_joints(synchro_) - robot_->motors_from_joints(synchro_);
    return other.forward_from_motors(motors) * T_WE_;
  }

  const robots::RobotType* type_;
  std::unique_ptr<edp::Robot> robot_;
  Pose T_WE_;
  AxisVector synchro_;  // empty: SYNCHRO finds switches
  AxisVector near_;     // before the balls
  ViewPlan views_;
};

std::string words(const SetsFit& fit) {
  std::vector<std::string> each;
  for (std::size_t arm = 0; arm < kArms; ++arm)
    if (!fit.names[arm].empty()) each.push_back(fmt::format("{} {}", kKeys[arm], fit.names[arm]));
  return fmt::format("{}", fmt::join(each, ", "));
}

std::string millimetres(const SetsFit& fit) {
  return fit.found ? fmt::format("{:.4f} mm", 1e3 * fit.rms) : "no balls";
}

}  // namespace

SetsVerdict fit_sets(const std::vector<mp::ArmTrace>& traces, const Config& config) {
  const std::array<Measuring, kArms> arms{Measuring(config, 0), Measuring(config, 1)};
  const std::array<ProbePlan, kArms> plans{read_plan(config, kKeys[0]), read_plan(config, kKeys[1])};
  SetsVerdict verdict;
  for (int first = 0; first < arms[0].sets(); ++first)
    for (int second = 0; second < arms[1].sets(); ++second) {
      SetsFit fit{.sets = {first, second}, .names = {arms[0].name(first), arms[1].name(second)}, .found = {}};
      fit.found = calibration_of(
          {arms[0].measured_with(traces.at(0), first), arms[1].measured_with(traces.at(1), second)}, plans);
      if (fit.found) fit.rms = misfit(*fit.found);
      verdict.fits.push_back(std::move(fit));
    }
  std::ranges::stable_sort(verdict.fits, {}, &SetsFit::rms);
  verdict.told_apart = verdict.fits[0].found &&
                       (verdict.fits.size() == 1 || verdict.fits[1].rms > kClearly * verdict.fits[0].rms);
  if (!verdict.told_apart) {
    const SetNumbers believed{arms[0].believed(), arms[1].believed()};
    verdict.chosen = static_cast<std::size_t>(std::ranges::find(verdict.fits, believed, &SetsFit::sets) -
                                              verdict.fits.begin());
  }
  return verdict;
}

SetNumbers believed_sets(const Config& config) {
  return {Measuring(config, 0).believed(), Measuring(config, 1).believed()};
}

std::vector<mp::ArmTrace> measured_with(const std::vector<mp::ArmTrace>& traces, const SetNumbers& sets,
                                        const Config& config) {
  std::vector<mp::ArmTrace> now;
  for (std::size_t arm = 0; arm < kArms; ++arm)
    now.push_back(Measuring(config, arm).measured_with(traces.at(arm), sets.at(arm)));
  return now;
}

std::string describe(const SetsVerdict& verdict) {
  if (verdict.fits.size() < 2) return {};
  std::string text;
  if (!verdict.told_apart)
    text =
        "the kinematic sets cannot be told apart by these touches: both arms keep what is believed of them\n";
  for (std::size_t k = 0; k < verdict.fits.size(); ++k) {
    const SetsFit& fit = verdict.fits[k];
    text += fmt::format("{} {}: touches and balls apart by {} rms\n",
                        k == verdict.chosen ? "kinematics:" : "  not", words(fit), millimetres(fit));
  }
  return text;
}

void add_figures(mp::TaskFigures& figures, const SetsVerdict& verdict, const SetNumbers& real) {
  const SetsFit& chosen = verdict.fits.at(verdict.chosen);
  double others = std::numeric_limits<double>::infinity(), wrong = 0;
  for (const SetsFit& fit : verdict.fits)
    if (&fit != &chosen) others = std::min(others, fit.rms);
  for (std::size_t arm = 0; arm < kArms; ++arm) wrong += chosen.sets[arm] != real[arm];
  const auto mm = [](double m) { return std::isfinite(m) ? 1e3 * m : NAN; };
  figures.insert(
      figures.end(),
      {{{"sets_rms_mm", "touches and balls off each other, by the kinematic sets chosen", "mm rms"},
        mm(chosen.rms)},
       {{"other_sets_rms_mm", "  by those of the others that fit best", "mm rms"}, mm(others)},
       {{.key = "sets_wrong",
         .words = "arms that have another kinematic set than chosen",
         .unit = "",
         .high = 0},
        chosen.found ? wrong : NAN}});
}

}  // namespace mrroc::calibrate_cell
