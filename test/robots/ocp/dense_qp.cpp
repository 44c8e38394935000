#include "test/robots/ocp/dense_qp.hpp"

#include <vector>

namespace mrroc::test {
namespace {

constexpr double kTolerance = 1e-9;

/// @return solution with these inequalities as equalities and no others, if it is one of the whole problem
std::optional<Eigen::VectorXd> with_active(const DenseQp& qp, const std::vector<Eigen::Index>& active) {
  const Eigen::Index n = qp.g.size();
  const Eigen::Index m = qp.e.size();
  const auto a = static_cast<Eigen::Index>(active.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + m + a, n + m + a);
  Eigen::VectorXd right(n + m + a);
  K.topLeftCorner(n, n) = qp.H;
  K.block(n, 0, m, n) = qp.E;
  right << -qp.g, qp.e, Eigen::VectorXd::Zero(a);
  for (Eigen::Index i = 0; i < a; ++i) {
    K.row(n + m + i).head(n) = qp.G.row(active[static_cast<std::size_t>(i)]);
    right[n + m + i] = qp.h[active[static_cast<std::size_t>(i)]];
  }
  K.topRightCorner(n, m + a) = K.bottomLeftCorner(m + a, n).transpose();
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(K);
  if (!lu.isInvertible()) return std::nullopt;
  const Eigen::VectorXd solution = lu.solve(right);
  const Eigen::VectorXd z = solution.head(n);
  // The multiplier of G z >= h is minus the one of the equation.
  const bool dual = a == 0 || solution.tail(a).maxCoeff() <= kTolerance;
  const bool primal = qp.h.size() == 0 || (qp.G * z - qp.h).minCoeff() >= -kTolerance;
  return dual && primal ? std::optional(z) : std::nullopt;
}

}  // namespace

std::optional<Eigen::VectorXd> solve(const DenseQp& qp) {
  for (unsigned set = 0; set < 1U << qp.h.size(); ++set) {
    std::vector<Eigen::Index> active;
    for (Eigen::Index i = 0; i < qp.h.size(); ++i)
      if ((set >> i & 1U) != 0) active.push_back(i);
    if (auto z = with_active(qp, active)) return z;
  }
  return std::nullopt;
}

}  // namespace mrroc::test
