// Every size up to 18 states and 18 controls, against the conditions of optimality: HPIPM's kernels are written for blocks of
// four, and those of some sizes were found wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "robots/ocp/ocp_qp.hpp"
#include "test/robots/ocp/random_qp.hpp"

namespace mrroc::ocp {
namespace {

using mrroc::test::points_of;
using mrroc::test::QpData;
using mrroc::test::QpPoints;
using mrroc::test::random_qp;
using mrroc::test::StageData;

/// @return how far the point is from one that fulfils the dynamics and whose gradient with respect to the controls pushes
///         against bounds only
double violation(const QpData& problem, const QpPoints& points) {
  double worst = 0;
  Eigen::VectorXd costate;
  for (std::size_t k = problem.stages.size(); k-- > 0;) {
    const StageData& d = problem.data[k];
    const Eigen::VectorXd& x = points.x[k];
    const Eigen::VectorXd& u = points.u[k];
    Eigen::VectorXd by_u = d.R * u + d.S * x + d.r;
    Eigen::VectorXd by_x = d.Q * x + d.S.transpose() * u + d.q;
    if (d.b.size() > 0) {
      worst = std::max(worst, (points.x[k + 1] - d.A * x - d.B * u - d.b).lpNorm<Eigen::Infinity>());
      by_u += d.B.transpose() * costate;
      by_x += d.A.transpose() * costate;
    }
    for (const int i : problem.stages[k].bounded_u) {
      constexpr double kNear = 1e-4;
      worst = std::max({worst, d.lower_u[i] - u[i], u[i] - d.upper_u[i]});
      if (u[i] < d.lower_u[i] + kNear) by_u[i] = std::min(by_u[i], 0.);
      if (u[i] > d.upper_u[i] - kNear) by_u[i] = std::max(by_u[i], 0.);
    }
    if (k == 0) worst = std::max(worst, by_x.lpNorm<Eigen::Infinity>());
    worst = std::max(worst, by_u.lpNorm<Eigen::Infinity>());
    costate = by_x;
  }
  return worst;
}

TEST(OcpQpSizes, AreSolvedRightlyOrRefused) {
  std::mt19937 random(11);
  int refused = 0;
  for (int n_x = 1; n_x <= 18; ++n_x)
    for (int n_u = 1; n_u <= 18; ++n_u)
      for (const bool known : {false, true}) {
        std::vector<Stage> stages = mrroc::test::equal_stages(4, n_x, n_u, known);
        for (Stage& s : stages)
          if (known)
            for (int i = 0; i < s.n_u; ++i) s.bounded_u.push_back(i);
        try {
          OcpQp qp(stages, 60);
          const QpData problem = random_qp(stages, random);
          set(qp, problem);
          ASSERT_TRUE(qp.solve().ok()) << n_x << ' ' << n_u;
          ASSERT_LT(violation(problem, points_of(qp, stages)), 1e-4) << n_x << ' ' << n_u;
        } catch (const std::invalid_argument&) {
          ++refused;
        }
      }
  EXPECT_EQ(refused, 8);
}

}  // namespace
}  // namespace mrroc::ocp
