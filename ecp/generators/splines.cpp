// Linear, cubic and quintic splines. Cubic and quintic ones are found in Hermite form: unknown are the
// derivatives at the inner knots, given that the next higher ones are continuous there.
#include <fmt/core.h>

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>

#include "ecp/generators/polynomials.hpp"

namespace mrroc::ecp {
namespace {

using Coefficients = Polynomials::Coefficients;
using Sparse = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;
using Values = Eigen::MatrixXd;  // row per knot, column per coordinate

[[noreturn]] void refuse(const std::string& what) { throw FaultError(FaultCode::bad_trajectory, what); }

void check(const std::vector<Knot>& knots) {
  if (knots.size() < 2) refuse("a spline needs two knots or more");
  for (std::size_t k = 0; k < knots.size(); ++k) {
    if (knots[k].pose.size() != knots[0].pose.size())
      refuse(
          fmt::format("knot {} has {} numbers instead of {}", k, knots[k].pose.size(), knots[0].pose.size()));
    if (!knots[k].pose.allFinite() || !std::isfinite(knots[k].t))
      refuse(fmt::format("knot {} has a number that is not finite", k));
    if (k > 0 && !(knots[k].t > knots[k - 1].t)) refuse(fmt::format("the time of knot {} does not rise", k));
  }
}

/// The knots by whole numbers: pose p(k), and the time h(k) from there to the next one.
class Track {
 public:
  /// @throws FaultError bad_trajectory
  explicit Track(const std::vector<Knot>& knots) : knots_(knots) { check(knots); }
  [[nodiscard]] int knots() const { return static_cast<int>(knots_.size()); }
  [[nodiscard]] Eigen::Index axes() const { return p(0).size(); }
  [[nodiscard]] const Coordinates& p(int k) const { return knots_[static_cast<std::size_t>(k)].pose; }
  [[nodiscard]] double h(int k) const { return time(k + 1) - time(k); }

 private:
  [[nodiscard]] double time(int k) const { return knots_[static_cast<std::size_t>(k)].t; }
  const std::vector<Knot>& knots_;
};

std::vector<double> times_of(const std::vector<Knot>& knots) {
  std::vector<double> times;
  for (const Knot& k : knots) times.push_back(k.t);
  return times;
}

/// Piece with given position, velocity and acceleration at both ends; h is its duration.
Coefficients quintic_piece(const Coordinates& p0, const Coordinates& v0, const Coordinates& a0,
                           const Coordinates& p1, const Coordinates& v1, const Coordinates& a1, double h) {
  const Coordinates d = (p1 - p0 - h * v0 - h * h / 2 * a0) / (h * h * h);
  const Coordinates e = (v1 - v0 - h * a0) / (h * h);
  const Coordinates f = (a1 - a0) / h;
  Coefficients c(p0.size(), 6);
  c << p0, v0, a0 / 2, 10 * d - 4 * e + f / 2, (-15 * d + 7 * e - f) / h, (6 * d - 3 * e + f / 2) / (h * h);
  return c;
}

CurvePtr assemble(const std::vector<Knot>& knots, const std::vector<Coefficients>& pieces) {
  return std::make_shared<Polynomials>(times_of(knots), pieces, knots.back().pose);
}

Values solve(int unknowns, const Entries& entries, const Values& right) {
  Sparse A(unknowns, unknowns);
  A.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Sparse> lu(A);
  if (lu.info() != Eigen::Success) refuse("the times of the knots are too different for a spline");
  return lu.solve(right);
}

}  // namespace

CurvePtr linear_spline(const std::vector<Knot>& knots) {
  check(knots);
  std::vector<Coefficients> pieces;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    Coefficients c = Coefficients::Zero(knots[k].pose.size(), 6);
    c.col(0) = knots[k].pose;
    c.col(1) = (knots[k + 1].pose - knots[k].pose) / (knots[k + 1].t - knots[k].t);
    pieces.push_back(c);
  }
  return assemble(knots, pieces);
}

CurvePtr cubic_spline(const std::vector<Knot>& knots) {
  const Track track(knots);
  const int n = track.knots();
  const auto h = [&](int k) { return track.h(k); };
  const auto p = [&](int k) -> const Coordinates& { return track.p(k); };
  Entries entries{{0, 0, 1}, {n - 1, n - 1, 1}};
  Values right = Values::Zero(n, track.axes());
  for (int k = 1; k + 1 < n; ++k) {
    entries.insert(entries.end(),
                   {{k, k - 1, 1 / h(k - 1)}, {k, k, 2 / h(k - 1) + 2 / h(k)}, {k, k + 1, 1 / h(k)}});
    right.row(k) = 3 * ((p(k) - p(k - 1)) / (h(k - 1) * h(k - 1)) + (p(k + 1) - p(k)) / (h(k) * h(k)));
  }
  const Values v = solve(n, entries, right);
  std::vector<Coefficients> pieces;
  for (int k = 0; k + 1 < n; ++k) {
    const Coordinates v0 = v.row(k).transpose();
    const Coordinates v1 = v.row(k + 1).transpose();
    const Coordinates slope = (p(k + 1) - p(k)) / h(k);
    Coefficients c = Coefficients::Zero(track.axes(), 6);
    c.col(0) = p(k);
    c.col(1) = v0;
    c.col(2) = (3 * slope - 2 * v0 - v1) / h(k);
    c.col(3) = (v0 + v1 - 2 * slope) / (h(k) * h(k));
    pieces.push_back(c);
  }
  return assemble(knots, pieces);
}

CurvePtr quintic_spline(const std::vector<Knot>& knots) {
  const Track track(knots);
  const int n = track.knots();
  const auto h = [&](int k) { return track.h(k); };
  const auto p = [&](int k) -> const Coordinates& { return track.p(k); };
  // Unknown 2k is the velocity at knot k, 2k + 1 the acceleration.
  const int last = 2 * n - 2;
  Entries entries{{0, 0, 1}, {1, 1, 1}, {last, last, 1}, {last + 1, last + 1, 1}};
  Values right = Values::Zero(2 * n, track.axes());
  for (int k = 1; k + 1 < n; ++k) {
    const double a = h(k - 1);
    const double b = h(k);
    const int i = 2 * k;
    // Third derivative from the left and from the right.
    entries.insert(entries.end(), {{i, i - 2, -24 / (a * a)},
                                   {i, i - 1, -3 / a},
                                   {i, i, -36 / (a * a) + 36 / (b * b)},
                                   {i, i + 1, 9 / a + 9 / b},
                                   {i, i + 2, 24 / (b * b)},
                                   {i, i + 3, -3 / b}});
    right.row(i) = -60 * (p(k) - p(k - 1)) / (a * a * a) + 60 * (p(k + 1) - p(k)) / (b * b * b);
    // Fourth derivative.
    const double a3 = a * a * a;
    const double b3 = b * b * b;
    entries.insert(entries.end(), {{i + 1, i - 2, 168 / a3},
                                   {i + 1, i - 1, 24 / (a * a)},
                                   {i + 1, i, 192 / a3 + 192 / b3},
                                   {i + 1, i + 1, -36 / (a * a) + 36 / (b * b)},
                                   {i + 1, i + 2, 168 / b3},
                                   {i + 1, i + 3, -24 / (b * b)}});
    right.row(i + 1) = 360 * ((p(k) - p(k - 1)) / (a3 * a) + (p(k + 1) - p(k)) / (b3 * b));
  }
  const Values x = solve(2 * n, entries, right);
  std::vector<Coefficients> pieces;
  for (int k = 0; k + 1 < n; ++k)
    pieces.push_back(quintic_piece(p(k), x.row(2 * k).transpose(), x.row(2 * k + 1).transpose(), p(k + 1),
                                   x.row(2 * k + 2).transpose(), x.row(2 * k + 3).transpose(), h(k)));
  return assemble(knots, pieces);
}

CurvePtr hold(const Coordinates& pose, double time) { return linear_spline({{0, pose}, {time, pose}}); }

CurvePtr constant_velocity(const Coordinates& from, const Coordinates& to, const MotionLimits& limits,
                           double fraction) {
  if (!(fraction > 0 && fraction <= 1)) refuse("the fraction of velocity must lie above 0 and up to 1");
  if (from.size() != to.size() || from.size() != limits.velocity.size())
    refuse("start, goal and limits have different sizes");
  const double time = (to - from).cwiseAbs().cwiseQuotient(fraction * limits.velocity).maxCoeff();
  return time > 0 ? linear_spline({{0, from}, {time, to}}) : hold(from, 1e-9);
}

std::vector<Knot> stretched(std::vector<Knot> knots, double factor) {
  for (std::size_t k = knots.size(); k-- > 0;) knots[k].t = (knots[k].t - knots[0].t) * factor + knots[0].t;
  return knots;
}

}  // namespace mrroc::ecp
