// The solver of optimal control problems, against dense solutions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "robots/ocp/ocp_qp.hpp"
#include "test/robots/ocp/dense_qp.hpp"
#include "test/robots/ocp/random_qp.hpp"

namespace mrroc::ocp {
namespace {

using mrroc::test::DenseQp;
using mrroc::test::points_of;
using mrroc::test::QpData;
using mrroc::test::QpPoints;
using mrroc::test::random_qp;
using mrroc::test::StageData;

/// Where the variables of the stages lie in a dense vector: u_0, x_0, u_1, x_1, ...
struct Layout {
  std::vector<Eigen::Index> u, x;
  Eigen::Index size{};

  explicit Layout(const std::vector<Stage>& stages) {
    for (const Stage& s : stages) {
      u.push_back(size);
      x.push_back(size + s.n_u);
      size += s.n_u + s.n_x;
    }
  }
};

/// Inequalities as they come.
class Rows {
 public:
  explicit Rows(Eigen::Index n) : n_(n) {}
  /// @return a row of zeros, to be filled, with its right side
  Eigen::VectorXd& add(double h) {
    h_.push_back(h);
    return rows_.emplace_back(Eigen::VectorXd::Zero(n_));
  }
  void into(DenseQp& qp) const {
    qp.G.resize(static_cast<Eigen::Index>(rows_.size()), n_);
    for (std::size_t i = 0; i < rows_.size(); ++i) qp.G.row(static_cast<Eigen::Index>(i)) = rows_[i];
    qp.h = Eigen::Map<const Eigen::VectorXd>(h_.data(), static_cast<Eigen::Index>(h_.size()));
  }

 private:
  Eigen::Index n_;
  std::vector<Eigen::VectorXd> rows_;
  std::vector<double> h_;
};

void add_bounds(const Stage& s, const StageData& d, const Layout& at, std::size_t k, Rows& rows) {
  for (std::size_t i = 0; i < s.bounded_u.size(); ++i) {
    rows.add(d.lower_u[static_cast<Eigen::Index>(i)])[at.u[k] + s.bounded_u[i]] = 1;
    rows.add(-d.upper_u[static_cast<Eigen::Index>(i)])[at.u[k] + s.bounded_u[i]] = -1;
  }
}

DenseQp dense(const QpData& problem) {
  const Layout at(problem.stages);
  DenseQp qp{Eigen::MatrixXd::Zero(at.size, at.size), Eigen::VectorXd::Zero(at.size), {}, {}, {}, {}};
  Rows rows(at.size);
  Eigen::Index equations = 0;
  for (const StageData& d : problem.data) equations += d.b.size();
  qp.E = Eigen::MatrixXd::Zero(equations, at.size);
  qp.e.resize(equations);
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < problem.stages.size(); ++k) {
    const Stage& s = problem.stages[k];
    const StageData& d = problem.data[k];
    qp.H.block(at.u[k], at.u[k], s.n_u, s.n_u) = d.R;
    qp.H.block(at.u[k], at.x[k], s.n_u, s.n_x) = d.S;
    qp.H.block(at.x[k], at.u[k], s.n_x, s.n_u) = d.S.transpose();
    qp.H.block(at.x[k], at.x[k], s.n_x, s.n_x) = d.Q;
    qp.g.segment(at.u[k], s.n_u) = d.r;
    qp.g.segment(at.x[k], s.n_x) = d.q;
    add_bounds(s, d, at, k, rows);
    if (d.b.size() == 0) continue;
    qp.E.block(row, at.x[k + 1], d.b.size(), d.b.size()).setIdentity();
    qp.E.block(row, at.x[k], d.b.size(), s.n_x) = -d.A;
    qp.E.block(row, at.u[k], d.b.size(), s.n_u) = -d.B;
    qp.e.segment(row, d.b.size()) = d.b;
    row += d.b.size();
  }
  rows.into(qp);
  return qp;
}

/// @return whether each number has the bits of its neighbour's
bool same_bits(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return std::ranges::equal(a, b, {}, std::bit_cast<std::uint64_t, double>,
                            std::bit_cast<std::uint64_t, double>);
}

/// @return the largest difference between the solver's point and the dense one
double distance(const QpPoints& points, const Eigen::VectorXd& z, const Layout& at) {
  double worst = points.x.empty() ? std::numeric_limits<double>::infinity() : 0;
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    const Eigen::VectorXd u = z.segment(at.u[k], points.u[k].size());
    const Eigen::VectorXd x = z.segment(at.x[k], points.x[k].size());
    worst = std::max(
        {worst, (u - points.u[k]).lpNorm<Eigen::Infinity>(), (x - points.x[k]).lpNorm<Eigen::Infinity>()});
  }
  return worst;
}

/// Solves both ways. @return whether there was a solution
bool agrees(const QpData& problem) {
  const auto z = mrroc::test::solve(dense(problem));
  OcpQp qp(problem.stages, 60);
  set(qp, problem);
  const QpResult result = qp.solve();
  EXPECT_EQ(result.ok(), z.has_value());
  if (!z || !result.ok()) return false;
  EXPECT_LT(distance(points_of(qp, problem.stages), *z, Layout(problem.stages)), 1e-5);
  return true;
}

TEST(OcpQp, AgreesWithADenseSolutionWithoutBounds) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const auto draw = [&](int from, int to) { return std::uniform_int_distribution(from, to)(random); };
    ASSERT_TRUE(agrees(
        random_qp(mrroc::test::equal_stages(draw(1, 8), draw(2, 6), draw(1, 5), draw(0, 1) == 1), random)));
  }
}

TEST(OcpQp, AgreesWithADenseSolutionWhereControlsHaveBounds) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    std::vector<Stage> stages = mrroc::test::equal_stages(3, 2 + i % 3, 2, i % 2 == 0);
    stages[0].bounded_u = {0, 1};
    stages[1].bounded_u = {1};
    stages[2].bounded_u = {0};
    ASSERT_TRUE(agrees(random_qp(stages, random)));
  }
}

TEST(OcpQp, TheSameDataGiveTheSameBitsWhateverWasSolvedBefore) {
  std::mt19937 random(5);
  std::vector<Stage> stages = mrroc::test::equal_stages(20, 10, 4, true);
  for (Stage& s : stages)
    if (s.n_u > 0) s.bounded_u = {0, 1, 2, 3};
  const QpData wanted = random_qp(stages, random);
  OcpQp fresh(stages, 60);
  OcpQp used(stages, 60);
  for (int i = 0; i < 5; ++i) {
    set(used, random_qp(stages, random));
    EXPECT_TRUE(used.solve().ok());
  }
  set(fresh, wanted);
  set(used, wanted);
  const QpResult a = fresh.solve();
  const QpResult b = used.solve();
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ(a.iterations, b.iterations);
  const QpPoints p = points_of(fresh, stages);
  const QpPoints q = points_of(used, stages);
  for (std::size_t k = 0; k < stages.size(); ++k) {
    EXPECT_TRUE(same_bits(p.x[k], q.x[k])) << k;
    EXPECT_TRUE(same_bits(p.u[k], q.u[k])) << k;
  }
}

TEST(OcpQp, NumbersThatAreNotFiniteAreNotSolvedAndLeaveNothingBehind) {
  std::mt19937 random(6);
  std::vector<Stage> stages = mrroc::test::equal_stages(4, 3, 2, true);
  for (Stage& s : stages)
    if (s.n_u > 0) s.bounded_u = {0, 1};
  const QpData good = random_qp(stages, random);
  OcpQp qp(stages, 60);
  for (int i = 0; i < 300; ++i) {
    QpData bad = good;
    const auto k = static_cast<std::size_t>(std::uniform_int_distribution(1, 3)(random));
    StageData& d = bad.data[k];
    const std::array numbers{d.A.data(), d.B.data(), d.b.data(), d.Q.data(),
                             d.R.data(), d.q.data(), d.r.data()};
    const double wrong = i % 2 == 0 ? std::nan("") : std::numeric_limits<double>::infinity();
    numbers[static_cast<std::size_t>(i) % numbers.size()][0] = wrong;
    set(qp, bad);
    EXPECT_EQ(qp.solve().status, QpStatus::not_solved) << i;
    set(qp, good);
    EXPECT_TRUE(qp.solve().ok()) << i;
  }
}

TEST(OcpQp, WhatHasNoSolutionEndsWithinTheIterations) {
  std::mt19937 random(7);
  std::vector<Stage> stages = mrroc::test::equal_stages(3, 2, 1, true);
  stages[0].bounded_u = {0};
  QpData problem = random_qp(stages, random);
  problem.data[0].lower_u << 51;  // above the upper one
  problem.data[0].upper_u << 50;
  OcpQp qp(stages, 25);
  set(qp, problem);
  const QpResult result = qp.solve();
  EXPECT_EQ(result.status, QpStatus::not_solved);
  EXPECT_LE(result.iterations, 25);
}

TEST(OcpQp, SizesThatDoNotFitAreToldByTheNextSolve) {
  std::mt19937 random(8);
  const QpData good = random_qp(mrroc::test::equal_stages(3, 3, 2, false), random);
  OcpQp qp(good.stages, 60);
  const auto refused = [&] {
    const bool told = qp.solve().status == QpStatus::bad_data;
    set(qp, good);
    return told && qp.solve().ok();
  };
  set(qp, good);
  const Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(3, 4);
  const StageData& d = good.data[0];
  qp.dynamics(0, wide, d.B, d.b);
  EXPECT_TRUE(refused());
  qp.dynamics(0, d.A, wide, d.b);
  EXPECT_TRUE(refused());
  qp.dynamics(0, d.A, d.B, wide);
  EXPECT_TRUE(refused());
  qp.dynamics(0, {}, d.B, d.b);
  EXPECT_TRUE(refused());
  for (const int k : {-1, 3, 4}) {
    qp.dynamics(k, d.A, d.B, d.b);
    EXPECT_TRUE(refused());
  }
  qp.cost(0, wide, {}, {}, {}, {});
  EXPECT_TRUE(refused());
  qp.cost(3, {}, {}, {}, {}, Eigen::Vector2d(1, 1));
  EXPECT_TRUE(refused());
  qp.bounds_u(0, Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1));
  EXPECT_TRUE(refused());
  qp.bounds_u(4, {}, {});
  EXPECT_TRUE(refused());
  Eigen::Vector2d out(7, 7);
  EXPECT_FALSE(qp.x(0, out) || qp.x(9, out) || qp.u(3, out) || qp.u(-1, out));
  EXPECT_EQ(out, Eigen::Vector2d(7, 7));
}

TEST(OcpQp, ProblemsThatCannotBeAreRefused) {
  const auto why = [](std::vector<Stage> stages, int iterations = 10) -> std::string {
    try {
      OcpQp qp(stages, iterations);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  const Stage middle{.n_x = 2, .n_u = 1};
  const Stage last{.n_x = 2};
  EXPECT_EQ(why({middle, last}), "");
  EXPECT_EQ(why({last}), "an optimal control problem has at least two stages");
  EXPECT_EQ(why({middle, last}, 0), "a solver of optimal control problems needs at least one iteration");
  EXPECT_EQ(why({middle, middle}), "stage 1 of an optimal control problem: the last one has no controls");
  EXPECT_EQ(why({middle, {.n_u = 1}, last}),
            "stage 1 of an optimal control problem: it has no state; only the first one may have none");
  EXPECT_EQ(why({{.n_x = -1}, last}), "stage 0 of an optimal control problem: a size is negative");
  EXPECT_NE(why({{.n_x = 2, .n_u = 1, .bounded_u = {1}}, last}), "");
  EXPECT_NE(why({{.n_x = 2, .n_u = 2, .bounded_u = {1, 0}}, last}), "");
  for (const int n_u : {3, 7, 11, 15})
    EXPECT_EQ(why({{.n_x = 1, .n_u = n_u}, {.n_x = 1}}),
              "stage 0 of an optimal control problem: HPIPM solves stages of one state and " +
                  std::to_string(n_u) + " controls wrongly; give it a second state");
}

}  // namespace
}  // namespace mrroc::ocp
