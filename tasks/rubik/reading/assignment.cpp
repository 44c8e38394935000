#include "tasks/rubik/reading/assignment.hpp"

#include <algorithm>
#include <limits>

namespace mrroc::rubik {

std::vector<int> least_cost_assignment(const Eigen::MatrixXd& cost) {
  const auto n = static_cast<std::size_t>(cost.rows());
  // Rows and columns are counted from 1; column 0 stands for the row that is being placed.
  std::vector<double> row_potential(n + 1);
  std::vector<double> column_potential(n + 1);
  std::vector<std::size_t> row_of(n + 1);
  std::vector<std::size_t> way(n + 1);
  for (std::size_t row = 1; row <= n; ++row) {
    row_of[0] = row;
    std::size_t column = 0;
    std::vector<double> least(n + 1, std::numeric_limits<double>::infinity());
    std::vector<char> visited(n + 1);
    do {
      visited[column] = 1;
      const std::size_t i = row_of[column];
      double step = std::numeric_limits<double>::infinity();
      std::size_t next = 0;
      for (std::size_t j = 1; j <= n; ++j) {
        if (visited[j] != 0) continue;
        const double reduced = cost(static_cast<Eigen::Index>(i - 1), static_cast<Eigen::Index>(j - 1)) -
                               row_potential[i] - column_potential[j];
        if (reduced < least[j]) least[j] = reduced, way[j] = column;
        if (least[j] < step) step = least[j], next = j;
      }
      for (std::size_t j = 0; j <= n; ++j) {
        if (visited[j] != 0)
          row_potential[row_of[j]] += step, column_potential[j] -= step;
        else
          least[j] -= step;
      }
      column = next;
    } while (row_of[column] != 0);
    for (; column != 0; column = way[column]) row_of[column] = row_of[way[column]];
  }
  std::vector<int> columns(n);
  for (std::size_t j = 1; j <= n; ++j) columns[row_of[j] - 1] = static_cast<int>(j - 1);
  return columns;
}

}  // namespace mrroc::rubik
