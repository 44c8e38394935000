// Dense quadratic programmes, solved by looking at every set of active constraints: slow, and without anything that
// could be wrong in the same way as an interior point method.
#pragma once
#include <Eigen/Dense>
#include <optional>

namespace mrroc::test {

/// min 1/2 z' H z + g' z  with  E z = e  and  G z >= h.
struct DenseQp {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  Eigen::MatrixXd E;
  Eigen::VectorXd e;
  Eigen::MatrixXd G;
  Eigen::VectorXd h;
};

/// @param qp  strictly convex, with a dozen inequalities at most
/// @return its only solution; none if no point fulfils the constraints
[[nodiscard]] std::optional<Eigen::VectorXd> solve(const DenseQp& qp);

}  // namespace mrroc::test
