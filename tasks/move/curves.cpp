#include "tasks/move/curves.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/representation.hpp"
#include "base/screw.hpp"
#include "ecp/generators/nurbs.hpp"
#include "ecp/generators/polyline.hpp"
#include "ecp/generators/polynomials.hpp"

namespace mrroc::any_motion {
namespace {

using ecp::Coordinates;
using CurvePtr = std::shared_ptr<const ecp::Curve>;

Pose pose_of(Representation space, const Coordinates& q) {
  return pose_from_numbers(space, numbers_from_axes(q)).value_or(Pose{});
}

/// Velocity from one set point to the next: of all axes, or of E along and about the axes of the base.
Coordinates velocity(Representation space, const Coordinates& from, const Coordinates& to, double time) {
  if (per_axis(space)) return (to - from) / time;
  const Pose a = pose_of(space, from), b = pose_of(space, to);
  Coordinates v(6);
  v << (b.p - a.p) / time, a.R * angle_axis_from_rotation(a.R.transpose() * b.R) / time;
  return v;
}

/// As multiples of the limits.
Coordinates share(Representation space, const Coordinates& v, const Coordinates& limit) {
  if (per_axis(space)) return v.cwiseQuotient(limit);
  Coordinates both(2);
  both << v.head<3>().norm() / limit[0], v.tail<3>().norm() / limit[3];
  return both;
}

/// What is computed beforehand has to be kept.
const CurvePtr& bounded(const CurvePtr& curve) {
  constexpr double kLongest = 3600;  // [s]
  if (!(curve->duration() <= kLongest))
    throw FaultError(FaultCode::bad_trajectory, fmt::format("the motion takes {:.3g} s, and may take {} s",
                                                            curve->duration(), kLongest));
  return curve;
}

/// By which factor a motion is too fast for these shares of its limits; at most 1: it is not.
double excess(const CurvePtr& curve, const MotionSpec& motion, int axes, const ecp::Pacing& pacing) {
  const ecp::Trajectory path(bounded(curve), {.space = motion.planned()}, pacing);
  const Rates rates = rates_of(path, motion.planned(), axes, pacing.macrostep_s());
  return std::max(largest(rates.velocity) / motion.velocity[0],
                  std::sqrt(largest(rates.acceleration) / motion.acceleration[0]));
}

/// The fastest curve within the shares: all times grow until it is slow enough.
/// @param make  the curve with times multiplied by a factor, which at 1 is rather too fast
CurvePtr fitted(const std::function<CurvePtr(double)>& make, const MotionSpec& motion, int axes,
                const ecp::Pacing& pacing) {
  constexpr int kMost = 200;
  constexpr double kMore = 1.0001;  // so that it ends
  double factor = 1;
  for (int k = 0; k < kMost; ++k) {
    CurvePtr curve = make(factor);
    const double times = excess(curve, motion, axes, pacing);
    if (times <= 1) return curve;
    factor *= kMore * times;
  }
  throw FaultError(FaultCode::bad_trajectory, "no times are found that keep to the limits; give them");
}

/// Shortest time from one position to the next at these shares of the limits [s].
double shortest(const Coordinates& from, const Coordinates& to, const ecp::MotionLimits& limits,
                double velocity_share, const ecp::Pacing& pacing) {
  const double time = (to - from).cwiseAbs().cwiseQuotient(velocity_share * limits.velocity).maxCoeff();
  return std::max(time, pacing.macrostep_s());
}

CurvePtr spline_of(const MotionSpec& motion, const std::vector<Coordinates>& way, int axes,
                   const ecp::Pacing& pacing) {
  const auto spline = [&](const std::vector<ecp::Knot>& knots) -> CurvePtr {
    return motion.generator == Generator::linear  ? ecp::linear_spline(knots)
           : motion.generator == Generator::cubic ? ecp::cubic_spline(knots)
                                                  : ecp::quintic_spline(knots);
  };
  std::vector<ecp::Knot> knots{{0, way[0]}};
  const ecp::MotionLimits limits = ecp::default_limits(motion.planned(), axes);
  for (std::size_t k = 1; k < way.size(); ++k) {
    const bool given = !motion.times.empty();
    const double t = given
                         ? motion.times[k - 1]
                         : knots.back().t + shortest(way[k - 1], way[k], limits, motion.velocity[0], pacing);
    knots.push_back({t, way[k]});
  }
  if (!motion.times.empty()) return spline(knots);
  return fitted([&](double factor) { return spline(ecp::stretched(knots, factor)); }, motion, axes, pacing);
}

CurvePtr nurbs_of(const MotionSpec& motion, const std::vector<Coordinates>& way, int axes,
                  const ecp::Pacing& pacing) {
  const auto curve = [&](double time) -> CurvePtr {
    return std::make_shared<ecp::Nurbs>(
        ecp::NurbsShape{
            .degree = motion.degree, .control = way, .weights = motion.weights, .knots = motion.knots},
        time);
  };
  if (motion.duration > 0) return curve(motion.duration);
  return fitted([&](double factor) { return curve(factor * 10 * pacing.macrostep_s()); }, motion, axes,
                pacing);
}

std::vector<ecp::ViaPoint> list_of(const MotionSpec& motion, const std::vector<Coordinates>& way) {
  const auto of = [](const std::vector<double>& shares, std::size_t k) {
    return shares.size() == 1 ? shares[0] : shares[k];
  };
  std::vector<ecp::ViaPoint> list;
  for (std::size_t k = 0; k + 1 < way.size(); ++k)
    list.push_back({way[k + 1], of(motion.velocity, k), of(motion.acceleration, k), motion.pass});
  return list;
}

CurvePtr straight_of(const MotionSpec& motion, const std::vector<Coordinates>& way) {
  std::vector<Pose> poses;
  for (const Coordinates& q : way) poses.push_back(pose_of(motion.planned(), q));
  return std::make_shared<ecp::StraightPath>(poses, motion.path);
}

CurvePtr made(const MotionSpec& motion, const Coordinates& from, int axes, const ecp::Pacing& pacing) {
  const ecp::MotionLimits limits = ecp::default_limits(motion.planned(), axes);
  const std::vector<Coordinates> way = way_of(motion, from);
  switch (motion.generator) {
    case Generator::trapezoid:
      return std::make_shared<ecp::Trapezoid>(from, list_of(motion, way), limits, pacing.macrostep_s());
    case Generator::polyline:
      return std::make_shared<ecp::Polyline>(from, list_of(motion, way), limits, pacing.macrostep_s());
    case Generator::nurbs:
      return nurbs_of(motion, way, axes, pacing);
    case Generator::straight:
      return straight_of(motion, way);
    case Generator::constant:
      return ecp::constant_velocity(from, way.back(), limits, motion.velocity[0]);
    case Generator::hold:
      return ecp::hold(from, motion.duration);
    case Generator::linear:
    case Generator::cubic:
    case Generator::quintic:
      return spline_of(motion, way, axes, pacing);
    case Generator::replay:
      break;
  }
  throw FaultError(FaultCode::internal_error, "a replay is no curve");
}

}  // namespace

Rates rates_of(const ecp::Trajectory& path, Representation space, int axes, double macrostep_s) {
  const ecp::MotionLimits limits = ecp::default_limits(space, axes);
  Rates rates;
  Coordinates before = Coordinates::Zero(limits.velocity.size());
  for (std::int64_t k = 0; k <= path.macrosteps(); ++k) {
    Coordinates now = Coordinates::Zero(before.size());
    if (k < path.macrosteps()) {
      now = velocity(space, path.set_position(k), path.set_position(k + 1), macrostep_s);
      rates.velocity.push_back(share(space, now, limits.velocity));
    }
    rates.acceleration.push_back(share(space, (now - before) / macrostep_s, limits.acceleration));
    before = now;
  }
  return rates;
}

double largest(const std::vector<Coordinates>& shares) {
  double most = 0;
  for (const Coordinates& s : shares) most = std::max(most, s.cwiseAbs().maxCoeff());
  return most;
}

std::vector<Coordinates> way_of(const MotionSpec& motion, const Coordinates& from) {
  const Representation space = motion.planned();
  std::vector<Coordinates> way{from};
  for (const Coordinates& given : motion.positions) {
    Coordinates q = given;
    if (motion.reference == Reference::relative) {
      if (per_axis(space))
        q = way.back() + given;
      else
        q = axes_from_numbers(numbers_from_pose(space, pose_of(space, way.back()) * pose_of(space, given)),
                              6);
    }
    way.push_back(ecp::nearest_coordinates(space, q, way.back()));
  }
  return way;
}

CurvePtr curve_of(const MotionSpec& motion, const Coordinates& from, int axes, const ecp::Pacing& pacing) {
  return bounded(made(motion, from, axes, pacing));
}

ecp::TaughtPath recording_of(const MotionSpec& motion, const Coordinates& from) {
  ecp::TaughtPath taught{.space = motion.planned(),
                         .reference = Reference::absolute,
                         .with_force = !motion.forces.empty(),
                         .poses = {}};
  const std::vector<Coordinates> way = way_of(motion, from);
  const auto force = [&](std::size_t k) { return motion.forces.empty() ? Wrench{} : motion.forces[k]; };
  if (motion.times.front() > 0) taught.poses.push_back({0, from, force(0)});
  for (std::size_t k = 0; k < motion.positions.size(); ++k)
    taught.poses.push_back({motion.times[k], way[k + 1], force(k)});
  return taught;
}

}  // namespace mrroc::any_motion
