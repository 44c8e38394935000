// Levenberg and Marquardt's minimum of a sum of squares, for poses. Only for the sources of this folder.
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace mrroc::vsp {

/// Goes from x to a minimum of problem.cost(x): until a step makes it smaller by less than 1e-10 of it, no step makes it
/// smaller, or it is infinite.
/// @tparam N  of the unknowns
/// @param problem  cost(x); linearise(x, JtJ, Jtr), Gauss's normal equations; moved(x, step)
/// @param steps    at most
/// @param most_damping  with more of it no step is tried
/// @return the cost at x
template <int N, class Problem, class X>
double minimise(const Problem& problem, X& x, int steps, double most_damping) {
  double cost = problem.cost(x);
  double damping = 1e-3;
  Eigen::Matrix<double, N, N> JtJ;
  Eigen::Matrix<double, N, 1> Jtr;
  for (int k = 0; k < steps && std::isfinite(cost); ++k) {
    problem.linearise(x, JtJ, Jtr);
    JtJ.diagonal() *= 1 + damping;
    const X next = problem.moved(x, -JtJ.ldlt().solve(Jtr));
    const double next_cost = problem.cost(next);
    if (next_cost < cost) {
      const bool settled = cost - next_cost < 1e-10 * cost;
      x = next;
      cost = next_cost;
      damping = std::max(1e-9, 0.1 * damping);
      if (settled) break;
    } else {
      damping *= 10;
      if (damping > most_damping || !std::isfinite(next_cost)) break;
    }
  }
  return cost;
}

}  // namespace mrroc::vsp
