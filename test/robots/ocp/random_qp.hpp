// Random optimal control problems, and their solutions.
#pragma once
#include <Eigen/Dense>
#include <random>
#include <vector>

#include "robots/ocp/ocp_qp.hpp"

namespace mrroc::test {

/// All numbers of one stage.
struct StageData {
  Eigen::MatrixXd A, B, Q, S, R;
  Eigen::VectorXd b, q, r;
  Eigen::VectorXd lower_u, upper_u;
};

/// A problem as OcpQp takes it.
struct QpData {
  std::vector<ocp::Stage> stages;
  std::vector<StageData> data;
};

/// Numbers of order 1: strictly convex, dynamics that do not grow, bounds near enough to be felt.
[[nodiscard]] QpData random_qp(std::vector<ocp::Stage> stages, std::mt19937& random);

/// @return stages 0..N of equal sizes without bounds  @param known  the first one has no state
[[nodiscard]] std::vector<ocp::Stage> equal_stages(int N, int n_x, int n_u, bool known);

/// Gives all to the solver.
void set(ocp::OcpQp& qp, const QpData& problem);

/// Points of all stages.
struct QpPoints {
  std::vector<Eigen::VectorXd> x, u;
};

/// @return what the solver has found
[[nodiscard]] QpPoints points_of(const ocp::OcpQp& qp, const std::vector<ocp::Stage>& stages);

}  // namespace mrroc::test
