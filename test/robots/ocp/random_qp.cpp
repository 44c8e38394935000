#include "test/robots/ocp/random_qp.hpp"

namespace mrroc::test {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index cols, std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(random); });
}

Eigen::VectorXd random_bounds(std::size_t n, double from, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(from, from + 0.4);
  return Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(n), [&] { return uniform(random); });
}

}  // namespace

std::vector<ocp::Stage> equal_stages(int N, int n_x, int n_u, bool known) {
  std::vector<ocp::Stage> stages(static_cast<std::size_t>(N) + 1, {.n_x = n_x, .n_u = n_u});
  if (known) stages.front().n_x = 0;
  stages.back().n_u = 0;
  return stages;
}

QpData random_qp(std::vector<ocp::Stage> stages, std::mt19937& random) {
  QpData problem;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const ocp::Stage& s = stages[k];
    const int next = k + 1 < stages.size() ? stages[k + 1].n_x : 0;
    const Eigen::MatrixXd L = random_matrix(s.n_u + s.n_x, s.n_u + s.n_x, random);
    const Eigen::MatrixXd H =
        L * L.transpose() + 0.1 * Eigen::MatrixXd::Identity(s.n_u + s.n_x, s.n_u + s.n_x);
    StageData d;
    d.R = H.topLeftCorner(s.n_u, s.n_u);
    d.S = H.topRightCorner(s.n_u, s.n_x);
    d.Q = H.bottomRightCorner(s.n_x, s.n_x);
    d.q = random_matrix(s.n_x, 1, random);
    d.r = random_matrix(s.n_u, 1, random);
    d.A = 0.4 * random_matrix(next, s.n_x, random);
    d.B = random_matrix(next, s.n_u, random);
    d.b = random_matrix(next, 1, random);
    d.lower_u = random_bounds(s.bounded_u.size(), -0.6, random);
    d.upper_u = random_bounds(s.bounded_u.size(), 0.2, random);
    problem.data.push_back(std::move(d));
  }
  problem.stages = std::move(stages);
  return problem;
}

void set(ocp::OcpQp& qp, const QpData& problem) {
  for (std::size_t i = 0; i < problem.data.size(); ++i) {
    const StageData& d = problem.data[i];
    const int k = static_cast<int>(i);
    qp.cost(k, d.Q, d.S, d.R, d.q, d.r);
    qp.bounds_u(k, d.lower_u, d.upper_u);
    if (i + 1 < problem.data.size()) qp.dynamics(k, d.A, d.B, d.b);
  }
}

QpPoints points_of(const ocp::OcpQp& qp, const std::vector<ocp::Stage>& stages) {
  QpPoints points;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    Eigen::VectorXd x(stages[i].n_x);
    Eigen::VectorXd u(stages[i].n_u);
    if (!qp.x(static_cast<int>(i), x) || !qp.u(static_cast<int>(i), u)) return {};
    points.x.push_back(x);
    points.u.push_back(u);
  }
  return points;
}

}  // namespace mrroc::test
