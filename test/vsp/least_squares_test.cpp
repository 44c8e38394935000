// The steps of Levenberg and Marquardt's method, and when it ends: problems of one unknown that write down where they are
// asked.
#include "vsp/least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace mrroc::vsp {
namespace {

using One = Eigen::Matrix<double, 1, 1>;

/// The sum of squares and its normal equations, which need not fit together.
struct Asked {
  std::function<double(double)> sum;
  std::function<double(double)> slope;  ///< J' r
  double curvature{1};                  ///< J' J
  mutable std::vector<double> places{};

  [[nodiscard]] double cost(double x) const {
    places.push_back(x);
    return sum(x);
  }
  void linearise(double x, One& JtJ, One& Jtr) const {
    JtJ(0, 0) = curvature;
    Jtr(0, 0) = slope(x);
  }
  [[nodiscard]] static double moved(double x, const One& step) { return x + step(0, 0); }
};

TEST(LeastSquares, StepsAreDampedByAThousandthAndByTenTimesLessAfterEverySuccess) {
  const Asked problem{
      .sum = [](double x) { return std::exp(-x); }, .slope = [](double) { return -1.0; }, .curvature = 1};
  double x = 2;
  const double cost = minimise<1>(problem, x, 12, 1e6);
  ASSERT_EQ(problem.places.size(), 13U) << "the number of steps";
  double at = 2, damping = 1e-3;
  for (const double place : problem.places) {
    EXPECT_NEAR(place, at, 1e-13);
    at += 1 / (1 + damping);
    damping = std::max(1e-9, damping / 10);
  }
  EXPECT_EQ(x, problem.places.back());
  EXPECT_EQ(cost, std::exp(-x));
}

TEST(LeastSquares, StepsThatMakeNothingSmallerAreDampedTenTimesMoreUntilTheBound) {
  for (const double most : {1e6, 1e3}) {
    const Asked problem{
        .sum = [](double) { return 5.0; }, .slope = [](double) { return 1.0; }, .curvature = 2};
    double x = 3;
    EXPECT_EQ(minimise<1>(problem, x, 30, 1.5 * most), 5.0);
    EXPECT_EQ(x, 3) << "as small is not smaller";
    ASSERT_EQ(problem.places.size(), most > 1e4 ? 11U : 8U);
    double damping = 1e-3;
    for (std::size_t k = 1; k < problem.places.size(); ++k, damping *= 10)
      EXPECT_NEAR(problem.places[k], 3 - 0.5 / (1 + damping), 1e-12) << k;
  }
}

TEST(LeastSquares, AFailureIsFollowedByAShorterStepFromTheSamePlace) {
  // A minimum at 1.9 that the full step to 3 oversteps.
  const Asked problem{.sum = [](double x) { return std::abs(x - 1.9); },
                      .slope = [](double) { return -3.0; }};
  double x = 0;
  (void)minimise<1>(problem, x, 6, 1e6);
  const std::vector<double>& p = problem.places;
  ASSERT_GE(p.size(), 6U);
  EXPECT_NEAR(p[1], 3 / 1.001, 1e-12);
  EXPECT_NEAR(p[2], p[1] + 3 / 1.0001, 1e-12);
  EXPECT_NEAR(p[3], p[1] + 3 / 1.001, 1e-12);
  EXPECT_NEAR(p[4], p[1] + 3 / 1.01, 1e-12);
  EXPECT_EQ(x, p[1]);
}

TEST(LeastSquares, ASuccessThatIsNextToNothingIsTheLastOne) {
  for (const double share : {0.9e-10, 1.1e-10}) {
    int calls = 0;
    double last = 7;
    const Asked problem{.sum = [&](double) { return calls++ == 0 ? last : last *= 1 - share; },
                        .slope = [](double) { return 1.0; }};
    double x = 0;
    const double cost = minimise<1>(problem, x, 5, 1e6);
    EXPECT_EQ(problem.places.size(), share < 1e-10 ? 2U : 6U);
    EXPECT_EQ(cost, last) << "it is taken all the same";
    EXPECT_EQ(x, problem.places.back());
  }
}

TEST(LeastSquares, NothingIsTriedFromAPlaceOrAfterAStepWithoutACost) {
  const double nowhere = std::numeric_limits<double>::infinity();
  double x = 1;
  const Asked begun{.sum = [=](double) { return nowhere; }, .slope = [](double) { return 1.0; }};
  EXPECT_EQ(minimise<1>(begun, x, 9, 1e6), nowhere);
  EXPECT_EQ(begun.places.size(), 1U);
  const Asked left{.sum = [=](double at) { return at < 0.5 ? nowhere : at; },
                   .slope = [](double) { return 1.0; }};
  EXPECT_EQ(minimise<1>(left, x, 9, 1e6), 1);
  EXPECT_EQ(left.places.size(), 2U);
  EXPECT_EQ(x, 1);
}

// Every unknown has its own damping, in its own unit.
TEST(LeastSquares, TheDiagonalIsDamped) {
  struct Two {
    [[nodiscard]] static double cost(const Eigen::Vector2d& x) { return -x.sum(); }
    static void linearise(const Eigen::Vector2d& /*x*/, Eigen::Matrix2d& JtJ, Eigen::Vector2d& Jtr) {
      JtJ << 4, 1, 1, 2;
      Jtr << -3, -5;
    }
    [[nodiscard]] static Eigen::Vector2d moved(const Eigen::Vector2d& x, const Eigen::Vector2d& by) {
      return x + by;
    }
  };
  Eigen::Vector2d x(0, 0);
  minimise<2>(Two{}, x, 1, 1e6);
  Eigen::Matrix2d damped;
  damped << 4.004, 1, 1, 2.002;
  EXPECT_LT((damped * x - Eigen::Vector2d(3, 5)).norm(), 1e-12);
}

}  // namespace
}  // namespace mrroc::vsp
