#include "tasks/rex_drive/planner/ecsa.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc::rex_drive {
namespace {

using std::numbers::pi;

constexpr int kHarmonics = 3;
constexpr int kBasis = 2 * kHarmonics + 1;
constexpr int kParameters = 2 * kBasis;
constexpr int kRows = 7;  // end pose, u(0), u(T)
constexpr int kPerKnot = 3;
constexpr int kPanels = kPerKnot * (static_cast<int>(kFragmentKnots) - 1);
constexpr int kNodes = 2 * kPanels + 1;  // ends and middles of the panels of Simpson's rule

using BasisRow = Eigen::Matrix<double, 1, kBasis>;
using Lambda = Eigen::Matrix<double, kParameters, 1>;  // of v, then of w
using Errors = Eigen::Matrix<double, kRows, 1>;
using Jacobian = Eigen::Matrix<double, kRows, kParameters>;

/// Values of the basis at the nodes, and their integrals since the beginning, with T = 1.
struct Basis {
  std::array<BasisRow, kNodes> value, integral;

  Basis() {
    for (int n = 0; n < kNodes; ++n) {
      const double t = static_cast<double>(n) / (kNodes - 1);
      auto& p = value[static_cast<std::size_t>(n)];
      auto& P = integral[static_cast<std::size_t>(n)];
      p(0) = 1;
      P(0) = t;
      for (int k = 1; k <= kHarmonics; ++k) {
        const double omega = k * pi;
        p(2 * k - 1) = std::sin(omega * t);
        p(2 * k) = std::cos(omega * t);
        P(2 * k - 1) = (1 - std::cos(omega * t)) / omega;
        P(2 * k) = std::sin(omega * t) / omega;
      }
    }
  }
};
const Basis& basis() {
  static const Basis values;
  return values;
}

/// Weight of a node in Simpson's rule over the whole horizon, T = 1.
double simpson(int n) {
  constexpr double kSixth = 1.0 / (6 * kPanels);
  if (n == 0 || n == kNodes - 1) return kSixth;
  return n % 2 == 1 ? 4 * kSixth : 2 * kSixth;
}

/// State and controls at a node; x and y are not known.
struct AtNode {
  double v, w, phi;
};
AtNode at_node(const EndPointProblem& problem, const Lambda& lambda, int n) {
  const auto k = static_cast<std::size_t>(n);
  const auto of_v = lambda.head<kBasis>(), of_w = lambda.tail<kBasis>();
  return {basis().value[k].dot(of_v), basis().value[k].dot(of_w),
          problem.from.p.phi + problem.duration * basis().integral[k].dot(of_w)};
}

/// Errors of the end pose and of the controls at both ends.
/// @param J  receives their derivatives: the variational equation of x and y along the way, whose phi is known in closed
///           form; may be null
Errors errors_of(const EndPointProblem& problem, const Lambda& lambda, Jacobian* J) {
  const double T = problem.duration;
  double x = problem.from.p.x, y = problem.from.p.y;
  if (J) J->setZero();
  for (int n = 0; n < kNodes; ++n) {
    const AtNode at = at_node(problem, lambda, n);
    const double weight = T * simpson(n), c = weight * std::cos(at.phi), s = weight * std::sin(at.phi);
    x += at.v * c;
    y += at.v * s;
    if (!J) continue;
    const auto k = static_cast<std::size_t>(n);
    J->block<1, kBasis>(0, 0) += c * basis().value[k];
    J->block<1, kBasis>(1, 0) += s * basis().value[k];
    J->block<1, kBasis>(0, kBasis) -= at.v * s * T * basis().integral[k];
    J->block<1, kBasis>(1, kBasis) += at.v * c * T * basis().integral[k];
  }
  const AtNode begin = at_node(problem, lambda, 0), end = at_node(problem, lambda, kNodes - 1);
  if (J) {
    J->block<1, kBasis>(2, kBasis) = T * basis().integral.back();
    J->block<1, kBasis>(3, 0) = J->block<1, kBasis>(4, kBasis) = basis().value.front();
    J->block<1, kBasis>(5, 0) = J->block<1, kBasis>(6, kBasis) = basis().value.back();
  }
  Errors e;
  e << x - problem.to.p.x, y - problem.to.p.y, end.phi - problem.to.p.phi, begin.v - problem.from.v,
      begin.w - problem.from.w, end.v - problem.to.v, end.w - problem.to.w;
  return e;
}

/// Inverse of the weights: the squared norm of u(.) in L2, with more for higher harmonics.
Lambda inverse_weights(double T, const EcsaSettings& settings) {
  Lambda inverse;
  for (int j = 0; j < kBasis; ++j) {
    const int k = (j + 1) / 2;
    const double weight = (k == 0 ? T : T / 2) * (1 + settings.smoothness * k * k);
    inverse(j) = 1 / (settings.steadiness * weight);
    inverse(kBasis + j) = 1 / weight;
  }
  return inverse;
}

/// Controls that begin and end as wanted, with the mean that the way needs. v is never zero all along: there the Jacobian
/// would be singular.
Lambda guess(const EndPointProblem& problem) {
  constexpr double kSlow = 0.01;
  const double T = problem.duration, dx = problem.to.p.x - problem.from.p.x,
               dy = problem.to.p.y - problem.from.p.y;
  Lambda lambda = Lambda::Zero();
  const auto set = [&](int first, double begin, double end, double mean) {
    lambda(first) = (begin + end) / 2;
    lambda(first + 2) = (begin - end) / 2;
    lambda(first + 1) = pi / 2 * (mean - lambda(first));
  };
  set(0, problem.from.v, problem.to.v, std::max(std::hypot(dx, dy) / T, kSlow));
  set(kBasis, problem.from.w, problem.to.w, (problem.to.p.phi - problem.from.p.phi) / T);
  return lambda;
}

/// One step of Newton's method, shortened until the errors become smaller.
void take_step(const EndPointProblem& problem, const EcsaSettings& k, const Lambda& inverse, const Errors& e,
               const Jacobian& J, Lambda& lambda) {
  const Eigen::Matrix<double, kParameters, kRows> WJt = inverse.asDiagonal() * J.transpose();
  Eigen::Matrix<double, kRows, kRows> D = J * WJt;
  D.diagonal().array() += k.damping * D.trace() / kRows;
  const Lambda d = WJt * D.ldlt().solve(e);
  const double before = e.norm();
  double share = 1;
  const auto better = [&] {
    return errors_of(problem, lambda - share * d, nullptr).norm() < (1 - 0.1 * share) * before;
  };
  for (int halving = 0; halving < k.max_halvings && !better(); ++halving) share /= 2;
  lambda -= share * d;
}

/// Fills in the points of the way and its extremes.
void describe(const EndPointProblem& problem, const Lambda& lambda, EndPointSolution& solution) {
  double x = problem.from.p.x, y = problem.from.p.y;
  AtNode before = at_node(problem, lambda, 0);
  const double h = problem.duration / kPanels;
  solution.knot[0] = problem.from;
  solution.least_v = solution.most_v = before.v;
  for (int panel = 0; panel < kPanels; ++panel) {
    const AtNode middle = at_node(problem, lambda, 2 * panel + 1),
                 after = at_node(problem, lambda, 2 * panel + 2);
    const auto simpson_of = [h](double a, double m, double b) { return h / 6 * (a + 4 * m + b); };
    const auto along = [](const AtNode& n) { return n.v * std::cos(n.phi); };
    const auto across = [](const AtNode& n) { return n.v * std::sin(n.phi); };
    x += simpson_of(along(before), along(middle), along(after));
    y += simpson_of(across(before), across(middle), across(after));
    solution.length += simpson_of(std::abs(before.v), std::abs(middle.v), std::abs(after.v));
    for (const AtNode& n : {before, middle, after}) {
      solution.least_v = std::min(solution.least_v, n.v);
      solution.most_v = std::max(solution.most_v, n.v);
      solution.most_w = std::max(solution.most_w, std::abs(n.w));
      solution.most_vw = std::max(solution.most_vw, std::abs(n.v * n.w));
    }
    if ((panel + 1) % kPerKnot == 0)
      solution.knot[static_cast<std::size_t>((panel + 1) / kPerKnot)] = {{x, y, after.phi}, after.v, after.w};
    before = after;
  }
  if (solution.converged) solution.knot.back() = problem.to;
}

}  // namespace

EndPointSolution solve(const EndPointProblem& problem, const EcsaSettings& settings) {
  EndPointSolution solution;
  const Lambda inverse = inverse_weights(problem.duration, settings);
  Lambda lambda = guess(problem);
  Jacobian J;
  Errors e = errors_of(problem, lambda, &J);
  while (e.norm() >= settings.tolerance && solution.iterations < settings.max_iterations) {
    take_step(problem, settings, inverse, e, J, lambda);
    e = errors_of(problem, lambda, &J);
    ++solution.iterations;
  }
  solution.error = e.norm();
  solution.converged = solution.error < settings.tolerance;
  describe(problem, lambda, solution);
  return solution;
}

}  // namespace mrroc::rex_drive
