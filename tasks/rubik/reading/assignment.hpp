// Solves the assignment problem.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace mrroc::rubik {

/// Gives every row a column of its own so that the sum of their costs is least: the Hungarian method (Kuhn, 1955) with
/// potentials, in O(n^3).
/// @param cost  square, finite
/// @return the column of each row; among equal sums always the same
[[nodiscard]] std::vector<int> least_cost_assignment(const Eigen::MatrixXd& cost);

}  // namespace mrroc::rubik
