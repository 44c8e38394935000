#include "tasks/move/plan.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/representation.hpp"
#include "ecp/generators/force.hpp"

namespace mrroc::any_motion {
namespace {

using ecp::Coordinates;

constexpr double kRounding = 1e-6;  // of a share of a limit

Coordinates coordinates_of(const Body& body, Representation space, const Coordinates& joints) {
  if (space == Representation::joints) return joints;
  if (space == Representation::motors) return body.motors(joints);
  return axes_from_numbers(numbers_from_pose(space, body.pose(joints)), 6);
}

std::optional<Coordinates> joints_of(const Body& body, Representation space, const Coordinates& q,
                                     const Coordinates& near) {
  if (space == Representation::joints) return q;
  if (space == Representation::motors) return body.joints_of_motors(q);
  return body.joints_of_pose(pose_from_numbers(space, numbers_from_axes(q)).value_or(Pose{}), near);
}

double time_of(std::int64_t k) { return static_cast<double>(k) * kPacing.macrostep_s(); }

/// Errors of generators, with the motion that they are about.
template <class Function>
auto naming(const std::string& name, Function function) {
  try {
    return function();
  } catch (const FaultError& e) {
    if (std::string_view(e.what()).starts_with(name)) throw;
    throw FaultError(e.fault().code, fmt::format("{}: {}", name, e.what()), std::string(e.remedy()));
  }
}

std::string what_is_limited(Representation space, Eigen::Index axis) {
  if (space == Representation::motors) return fmt::format("motor {}", axis + 1);
  if (space == Representation::joints) return fmt::format("joint {}", axis + 1);
  return axis == 0 ? "the tip" : "the orientation";
}

/// A factor as it is told: the very number has to be enough.
double rounded_up(double times) { return std::ceil(100 * times - 1e-6) / 100; }

/// @return how many times as long a replay has to take: by how much its corners are less sharp then is found by trying
double least_stretch(const PlannedMotion& m, double times, int axes) {
  constexpr double kMost = 100, kMore = 1.05;
  const ecp::TaughtPath taught = recording_of(m.spec, m.path.set_position(0));
  const auto too_fast = [&] {
    ecp::TaughtPath slower = taught;
    for (ecp::TaughtPose& p : slower.poses) p.t *= times;
    const ecp::Replay replay(slower, m.spec.mu, kPacing);
    const Rates rates = rates_of(replay.path(), m.spec.planned(), axes, kPacing.macrostep_s());
    return largest(rates.velocity) > 1 || largest(rates.acceleration) > 1;
  };
  while (times < kMost && too_fast()) times = rounded_up(kMore * times);
  return times;
}

/// What to do about a motion with times that is too fast.
std::string remedy_of(const MotionSpec& spec, double times) {
  std::string text = fmt::format("give it {:.4g} times the time", times);
  if (spec.generator != Generator::replay) return text;
  return text + " by `stretch`, or by `times` that are written by hand" +
         (spec.space == Representation::motors
              ? "; or set space = \"joints\", whose limits are wider than those of motors"
              : "");
}

/// @throws FaultError too_fast  for the first of these that is above its limit
void demand_within(const std::vector<Coordinates>& shares, const MotionSpec& spec, const char* what,
                   const std::string& remedy) {
  for (std::size_t k = 0; k < shares.size(); ++k)
    for (Eigen::Index axis = 0; axis < shares[k].size(); ++axis)
      if (const double share = std::abs(shares[k][axis]); !(share <= 1 + kRounding))
        throw FaultError(FaultCode::too_fast,
                         fmt::format("{}, {:.2f} s after its beginning: {} of {} is {:.0f} % of its limit",
                                     spec.name, time_of(static_cast<std::int64_t>(k)), what,
                                     what_is_limited(spec.planned(), axis), 100 * share),
                         remedy);
}

void check_rates(const PlannedMotion& m, int axes) {
  const double v = largest(m.rates.velocity), a = largest(m.rates.acceleration);
  double times = rounded_up(std::max(v, std::sqrt(a)) * 1.01);
  std::string remedy = "give it more time, or smaller shares of the limits";
  if (times > 1 && m.replay) times = least_stretch(m, times, axes);
  if (!m.spec.times.empty() || m.spec.duration > 0) remedy = remedy_of(m.spec, times);
  demand_within(m.rates.velocity, m.spec, "speed", remedy);
  demand_within(m.rates.acceleration, m.spec, "acceleration", remedy);
}

/// Joints and poses at all set points. @throws FaultError unreachable_pose
void follow(PlannedMotion& m, const Body& body, const Coordinates& from) {
  Coordinates joints = from;
  for (std::int64_t k = 0; k <= m.path.macrosteps(); ++k) {
    const auto there = joints_of(body, m.spec.planned(), m.path.set_position(k), joints);
    if (!there)
      throw FaultError(FaultCode::unreachable_pose,
                       fmt::format("{}, {:.2f} s after its beginning: the pose is out of the arm's reach",
                                   m.spec.name, time_of(k)));
    joints = *there;
    m.joints.push_back(joints);
    m.poses.push_back(body.pose(joints));
  }
}

/// Makes the motions of one arm.
class Planner {
 public:
  explicit Planner(const Body& body, Coordinates start) : body_(body), joints_(std::move(start)) {}

  /// @param time  that it has to last at least [s]
  PlannedMotion plan(const MotionSpec& spec, double time) const {
    PlannedMotion m{
        .spec = spec, .path = {}, .replay = {}, .rows = {}, .rates = {}, .joints = {}, .poses = {}};
    const Coordinates from = coordinates_of(body_, spec.planned(), joints_);
    const ecp::Coding coding{spec.planned(), spec.reference, spec.mu};
    if (spec.generator == Generator::replay) {
      ecp::TaughtPath taught = recording_of(spec, from);
      const double span = taught.poses.back().t;
      if (span < time)
        for (ecp::TaughtPose& p : taught.poses) p.t *= time / span;
      m.replay.emplace(taught, spec.mu, kPacing);
      m.path = m.replay->path();
      for (const Axis axis : spec.contact) m.rows[axis] = ecp::guided({axis})[axis];
    } else {
      std::shared_ptr<const ecp::Curve> curve = curve_of(spec, from, body_.axes(), kPacing);
      if (curve->duration() < time) curve = std::make_shared<Stretched>(curve, time);
      m.path = ecp::Trajectory(curve, coding, kPacing);
    }
    m.rates = rates_of(m.path, spec.planned(), body_.axes(), kPacing.macrostep_s());
    follow(m, body_, joints_);
    return m;
  }
  /// The next motion begins where this one ends.
  void go_on_from(const PlannedMotion& m) { joints_ = m.joints.back(); }

 private:
  const Body& body_;
  Coordinates joints_;
};

double seconds(const PlannedMotion& m) { return time_of(m.path.macrosteps()); }

}  // namespace

std::string_view to_string(Generator g) {
  constexpr std::array<std::string_view, 10> kNames{"trapezoid", "polyline", "linear",   "cubic", "quintic",
                                                    "nurbs",     "straight", "constant", "hold",  "replay"};
  return kNames.at(static_cast<std::size_t>(g));
}

ArmCommand PlannedMotion::command(std::int64_t k) const {
  ArmCommand command = replay ? replay->command(k, rows) : path.command(k);
  if (spec.space != spec.planned()) {
    const auto T = pose_from_numbers(spec.planned(), command.pose);
    command.pose = numbers_from_pose(spec.space, T.value_or(Pose{}));
    command.representation = spec.space;
  }
  return command;
}

Plan make_plan(const MotionFile& file, std::span<const Body* const> bodies) {
  Plan plan{.together = file.together, .arms = {}};
  std::vector<Planner> planners;
  std::size_t most = 0;
  for (std::size_t arm = 0; arm < file.arms.size(); ++arm) {
    const ArmMotions& motions = file.arms[arm];
    const Coordinates start = motions.start.value_or(bodies[arm]->usual_start());
    plan.arms.push_back({.arm = motions.arm, .moves = motions.moves(), .start = start, .motions = {}});
    planners.emplace_back(*bodies[arm], start);
    most = std::max(most, motions.motions.size());
  }
  for (std::size_t k = 0; k < most; ++k) {
    const auto plan_all = [&](double time) {
      double longest = 0;
      for (std::size_t arm = 0; arm < plan.arms.size(); ++arm) {
        if (k >= file.arms[arm].motions.size()) continue;
        const MotionSpec& spec = file.arms[arm].motions[k];
        std::vector<PlannedMotion>& motions = plan.arms[arm].motions;
        motions.resize(k);
        motions.push_back(naming(spec.name, [&] { return planners[arm].plan(spec, time); }));
        longest = std::max(longest, seconds(motions.back()));
      }
      return longest;
    };
    const double longest = plan_all(0);
    if (plan.together) plan_all(longest);
    for (std::size_t arm = 0; arm < plan.arms.size(); ++arm) {
      if (k >= file.arms[arm].motions.size()) continue;
      check_rates(plan.arms[arm].motions[k], bodies[arm]->axes());
      planners[arm].go_on_from(plan.arms[arm].motions[k]);
    }
  }
  return plan;
}

std::string describe_plan(const Plan& plan) {
  std::string text = fmt::format("{:24} {:10} {:15} {:5} {:>9} {:>8} {:>13}\n", "motion", "generator",
                                 "space", "mu", "time [s]", "speed", "acceleration");
  for (const ArmPlan& arm : plan.arms)
    for (const PlannedMotion& m : arm.motions) {
      constexpr std::array<std::string_view, 5> kSpaces{"motors", "joints", "frame", "xyz_euler_zyz",
                                                        "xyz_angle_axis"};
      text += fmt::format("{:24} {:10} {:15} {:5} {:9.2f} {:6.0f} % {:11.0f} %\n", m.spec.name,
                          to_string(m.spec.generator), kSpaces.at(static_cast<std::size_t>(m.spec.space)),
                          m.spec.mu == Interpolation::mim ? "mim" : "tcim", seconds(m),
                          100 * largest(m.rates.velocity), 100 * largest(m.rates.acceleration));
    }
  return text;
}

}  // namespace mrroc::any_motion
