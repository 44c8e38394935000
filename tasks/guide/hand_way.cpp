#include "tasks/guide/hand_way.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mrroc::guide {
namespace {

using std::numbers::pi;

constexpr double kStep = 0.01;       // between points [s]
constexpr double kRest = 1;          // at the ends [s]
constexpr double kFade = 1;          // of the push, at the beginning and the end of the way [s]
constexpr double kApproach = 0.03;   // speed from off the fixture [m/s]
constexpr double kAhead = 0.03;      // he sees bends so far ahead [m]
constexpr double kSeen = 0.001;      // between the places that he looks at [m]
constexpr double kBraking = 2.5e-4;  // the same for which he slows down [m]
// Into a bend he wants to be by so much of its radius: beyond its middle he would pull the tool back along the curve.
constexpr double kInto = 0.5;
// Where he wants to be goes around the outside of a bend no quicker than his hand does elsewhere, in shares of its speed.
constexpr double kAround = 1;

/// What he leads along, by its length.
struct Way {
  Curve line;
  std::vector<double> stops;  // lengths, in their order; beyond the ends there are walls [m]
};

/// So far beyond an end a hand wants to be that pushes with that force.
double beyond(const OperatorPlan& plan) {
  return plan.wall_push / plan.learnt.wall_stiffness + plan.learnt.wall_softness / 2 +
         plan.wall_push * plan.compliance;
}

/// An eight over the whole plane and into its walls.
Curve eight(const std::array<double, 2>& sides, double more) {
  Points points;
  const int pieces = 720;
  for (int n = 0; n < pieces; ++n) {
    const double angle = 2 * pi * n / pieces;
    points.emplace_back((sides[0] / 2 + more) * std::sin(angle), (sides[1] / 2 + more) * std::sin(2 * angle));
  }
  return {points, true, 0};
}

Way way_along(const Setup& k, const OperatorPlan& plan) {
  const double more = beyond(plan);
  if (k.fixture.is_plane()) {
    const Curve line = eight(k.fixture.sides(), more);
    return {line, {0, line.length()}};
  }
  const Curve& line = *k.fixture.curve();
  const double length = line.length();
  if (line.closed()) return {line, {0, 1.5 * length, 0.5 * length}};
  return {line, {0.3 * length, length + more, -more, 0.5 * length}};
}

class Writer {
 public:
  Writer(const Setup& k, const OperatorPlan& plan) : k_(k), plan_(plan), way_(way_along(k, plan)) {}

  std::vector<WayPoint> write() {
    place_ = way_.stops.front();
    const double time = std::max(plan_.start / kApproach, kStep);
    for (double t = 0; t < time; t += kStep) add(plan_.start * (1 - smooth(t / time)));
    rest(k_.entry + kRest);
    for (std::size_t n = 1; n < way_.stops.size(); ++n) go_to(way_.stops[n], n + 1 == way_.stops.size());
    for (double t = 0; t < kFade + kRest; t += kStep) {
      strength_ = std::max(0.0, strength_ - kStep / kFade);
      add(0);
    }
    return std::move(points_);
  }

 private:
  void rest(double time) {
    for (double t = 0; t < time; t += kStep) add(0);
  }
  /// With the acceleration that is allowed, slower in bends and before them.
  void go_to(double goal, bool last) {
    const double sense = goal < place_ ? -1 : 1;
    double speed = 0;
    while (sense * (goal - place_) > 1e-6) {
      const double ahead = sense * (goal - place_);
      const double wanted = std::min(std::sqrt(plan_.acceleration * ahead), fastest(sense));
      speed = std::min(wanted, speed + plan_.acceleration * kStep);
      place_ += sense * std::min(ahead, std::max(speed, 1e-3) * kStep);
      strength_ = std::min(1.0, strength_ + kStep / kFade);
      look_ahead();
      add(0);
    }
    if (!last) rest(kRest);
  }
  /// Fastest at a place. In a bend he pulls the tool no harder than elsewhere, where it is damped less.
  [[nodiscard]] double fastest_at(double place) const {
    const double radius = way_.line.narrowest(place);
    const double bend = std::sqrt(plan_.acceleration * radius);
    const double around = kAround * plan_.speed * radius / (radius + pushed());
    const double mobility = rows(k_.law, k_.fixture, {.s = place}, 1).x.mobility;
    return std::min({bend, around, plan_.speed * mobility / k_.law.free_mobility});
  }
  /// Fastest where he is, so that he can still slow down for what he sees ahead.
  [[nodiscard]] double fastest(double sense) const {
    double speed = plan_.speed;
    for (double s = 0; s <= kAhead; s += kBraking)
      speed =
          std::min(speed, std::hypot(fastest_at(place_ + sense * s), std::sqrt(2 * plan_.acceleration * s)));
    return speed;
  }
  /// So far off the curve he wants to be: as far as the force takes both springs, the fixture's and that of the hand.
  [[nodiscard]] double pushed() const {
    return smooth(strength_) * plan_.push * (plan_.compliance + 1 / plan_.learnt.stiffness);
  }
  /// How much of his push he can give to the left and to the right, in the bends around him.
  void look_ahead() {
    std::array most{1.0, 1.0};
    for (double s = -kAhead; s <= kAhead; s += kSeen) {
      const Point before = way_.line.at(place_ + s - kSeen / 2).tangent;
      const Point behind = way_.line.at(place_ + s + kSeen / 2).tangent;
      const bool left = before.x() * behind.y() - before.y() * behind.x() > 0;
      const double into = kInto * way_.line.radius(way_.line.at(place_ + s).s);
      double& side = most[left ? 0 : 1];
      side = std::min(side, into / std::max(pushed(), into));
    }
    for (const std::size_t side : {0U, 1U})
      share_[side] = std::clamp(most[side], share_[side] - 2 * kStep / kFade, share_[side] + kStep / kFade);
  }
  void add(double above) {
    const CurvePlace on = way_.line.at(place_);
    const Point p = on.point + (way_.line.closed() ? 0 : place_ - on.s) * on.tangent;
    const double off = pushed();
    const double angle = 2 * pi * t_ / plan_.turn;
    const Point across = k_.fixture.is_plane() ? Point(0, 0) : Point(-on.tangent.y(), on.tangent.x());
    const double sideways = std::cos(angle);
    const Point q = p + share_[sideways > 0 ? 0 : 1] * off * sideways * across;
    points_.push_back({t_, k_.fixture.T_0F() * Vector3(q.x(), q.y(), above + off * std::sin(angle))});
    t_ += kStep;
  }

  const Setup& k_;
  const OperatorPlan& plan_;
  Way way_;
  std::vector<WayPoint> points_;
  double t_{}, place_{}, strength_{};
  std::array<double, 2> share_{1,
                               1};  // of the push in the plane of the fixture, to the left and to the right
};

}  // namespace

std::vector<WayPoint> hand_way(const Setup& k, const OperatorPlan& plan) { return Writer(k, plan).write(); }

}  // namespace mrroc::guide
