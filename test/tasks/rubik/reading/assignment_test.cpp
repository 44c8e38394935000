#include "tasks/rubik/reading/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace mrroc::rubik {
namespace {

double sum_of(const Eigen::MatrixXd& cost, const std::vector<int>& columns) {
  double sum = 0;
  for (std::size_t row = 0; row < columns.size(); ++row) sum += cost(static_cast<int>(row), columns[row]);
  return sum;
}

TEST(Assignment, CostsAsLittleAsTheBestOfAllPermutations) {
  std::mt19937 random(5);
  std::uniform_real_distribution<> number(-3, 10);
  for (int round = 0; round < 60; ++round) {
    const int n = 1 + round % 7;
    Eigen::MatrixXd cost(n, n);
    for (double& x : cost.reshaped()) x = round % 3 == 0 ? std::round(number(random)) : number(random);
    std::vector<int> columns(static_cast<std::size_t>(n));
    std::iota(columns.begin(), columns.end(), 0);
    double best = sum_of(cost, columns);
    while (std::ranges::next_permutation(columns).found) best = std::min(best, sum_of(cost, columns));
    const std::vector<int> found = least_cost_assignment(cost);
    EXPECT_NEAR(sum_of(cost, found), best, 1e-9);
    EXPECT_TRUE(std::ranges::is_permutation(found, columns));
  }
}

}  // namespace
}  // namespace mrroc::rubik
