#include "robots/ocp/ocp_qp.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>
#include <utility>

extern "C" {
#include <blasfeo.h>
#include <hpipm_d_ocp_qp.h>
#include <hpipm_d_ocp_qp_dim.h>
#include <hpipm_d_ocp_qp_ipm.h>
#include <hpipm_d_ocp_qp_sol.h>
}

namespace mrroc::ocp {
namespace {

/// Blocks of memory as HPIPM wants them, for as long as this lives.
class Memory {
 public:
  void* block(std::size_t size) {
    constexpr std::size_t kCacheLine = 64;
    const std::size_t whole = (size / kCacheLine + 2) * kCacheLine;
    blocks_.emplace_back(std::aligned_alloc(kCacheLine, whole));
    if (!blocks_.back()) throw std::bad_alloc();
    std::memset(blocks_.back().get(), 0, whole);
    return blocks_.back().get();
  }

 private:
  struct Free {
    void operator()(void* block) const noexcept { std::free(block); }  // NOLINT(cppcoreguidelines-no-malloc)
  };
  std::vector<std::unique_ptr<void, Free>> blocks_;
};

[[noreturn]] void refuse(std::size_t k, std::string_view why) {
  throw std::invalid_argument(fmt::format("stage {} of an optimal control problem: {}", k, why));
}

/// @return whether they are ascending, from 0 to below `end`
bool ascends(const std::vector<int>& indices, int end) {
  int last = -1;
  for (const int i : indices) {
    if (i <= last || i >= end) return false;
    last = i;
  }
  return true;
}

void check(std::span<const Stage> stages, int iterations) {
  if (stages.size() < 2) throw std::invalid_argument("an optimal control problem has at least two stages");
  if (iterations < 1)
    throw std::invalid_argument("a solver of optimal control problems needs at least one iteration");
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const Stage& s = stages[k];
    if (s.n_x < 0 || s.n_u < 0) refuse(k, "a size is negative");
    if (s.n_x == 0 && k > 0) refuse(k, "it has no state; only the first one may have none");
    if (!ascends(s.bounded_u, s.n_u)) refuse(k, "bounded_u are no ascending indices of its controls");
    // HPIPM as it comes with CasADi 3.8.2 says of such stages that they are solved, and gives wrong points.
    if (s.n_x == 1 && s.n_u % 4 == 3)
      refuse(k,
             fmt::format("HPIPM solves stages of one state and {} controls wrongly; give it a second state",
                         s.n_u));
  }
  if (stages.back().n_u != 0) refuse(stages.size() - 1, "the last one has no controls");
}

/// HPIPM only reads what it is given, but does not say so.
double* given(View v) noexcept {
  return const_cast<double*>(v.data);
}  // NOLINT(cppcoreguidelines-pro-type-const-cast)
int* given(const std::vector<int>& v) noexcept { return const_cast<int*>(v.data()); }

bool is(View v, Eigen::Index rows, Eigen::Index cols) noexcept { return v.rows == rows && v.cols == cols; }
bool is_empty(View v) noexcept { return v.rows == 0 || v.cols == 0; }

}  // namespace

struct OcpQp::Solver {
  Solver(std::span<const Stage> s, int iterations) : stages(s.begin(), s.end()) {
    const int N = static_cast<int>(stages.size()) - 1;
    d_ocp_qp_dim_create(N, &dim, memory.block(d_ocp_qp_dim_memsize(N)));
    set_sizes();
    d_ocp_qp_create(&dim, &qp, memory.block(d_ocp_qp_memsize(&dim)));
    for (int k = 0; k <= N; ++k)
      d_ocp_qp_set_idxbu(k, given(stages[static_cast<std::size_t>(k)].bounded_u), &qp);
    d_ocp_qp_sol_create(&dim, &sol, memory.block(d_ocp_qp_sol_memsize(&dim)));
    d_ocp_qp_ipm_arg_create(&dim, &arg, memory.block(d_ocp_qp_ipm_arg_memsize(&dim)));
    d_ocp_qp_ipm_arg_set_default(ROBUST, &arg);
    d_ocp_qp_ipm_arg_set_iter_max(&iterations, &arg);
    d_ocp_qp_ipm_ws_create(&dim, &arg, &ws, memory.block(d_ocp_qp_ipm_ws_memsize(&dim, &arg)));
  }

  void set_sizes() {
    std::vector<int> n_x, n_u, bounded;
    for (const Stage& s : stages) {
      n_x.push_back(s.n_x);
      n_u.push_back(s.n_u);
      bounded.push_back(static_cast<int>(s.bounded_u.size()));
    }
    std::vector<int> none(stages.size());  // bounds of states, general constraints, soft bounds
    d_ocp_qp_dim_set_all(n_x.data(), n_u.data(), none.data(), bounded.data(), none.data(), none.data(), &dim);
  }

  [[nodiscard]] const Stage* stage(int k) const noexcept {
    return k >= 0 && static_cast<std::size_t>(k) < stages.size() ? &stages[static_cast<std::size_t>(k)]
                                                                 : nullptr;
  }

  /// @return whether all sizes fit; if not, it is remembered
  bool fits(bool sizes) noexcept {
    bad_data = bad_data || !sizes;
    return sizes;
  }

  Memory memory;
  std::vector<Stage> stages;
  bool bad_data{};
  d_ocp_qp_dim dim{};
  d_ocp_qp qp{};
  d_ocp_qp_sol sol{};
  d_ocp_qp_ipm_arg arg{};
  d_ocp_qp_ipm_ws ws{};
};

OcpQp::OcpQp(std::span<const Stage> stages, int iterations) {
  check(stages, iterations);
  solver_ = std::make_unique<Solver>(stages, iterations);
}
OcpQp::~OcpQp() = default;
OcpQp::OcpQp(OcpQp&&) noexcept = default;
OcpQp& OcpQp::operator=(OcpQp&&) noexcept = default;

void OcpQp::dynamics(int k, View A, View B, View b) noexcept {
  const Stage* s = solver_->stage(k);
  const Stage* next = k < 0 ? nullptr : solver_->stage(k + 1);
  if (!solver_->fits(s != nullptr && next != nullptr)) return;
  if (!solver_->fits((s->n_x == 0 && is_empty(A)) || is(A, next->n_x, s->n_x)) ||
      !solver_->fits((s->n_u == 0 && is_empty(B)) || is(B, next->n_x, s->n_u)) ||
      !solver_->fits(is(b, next->n_x, 1)))
    return;
  if (s->n_x > 0) d_ocp_qp_set_A(k, given(A), &solver_->qp);
  if (s->n_u > 0) d_ocp_qp_set_B(k, given(B), &solver_->qp);
  d_ocp_qp_set_b(k, given(b), &solver_->qp);
}

void OcpQp::cost(int k, View Q, View S, View R, View q, View r) noexcept {
  const Stage* s = solver_->stage(k);
  if (!solver_->fits(s != nullptr)) return;
  struct Part {
    View v;
    int rows, cols;
    void (*set)(int, double*, d_ocp_qp*);
  };
  for (const Part& part : {Part{Q, s->n_x, s->n_x, d_ocp_qp_set_Q}, Part{S, s->n_u, s->n_x, d_ocp_qp_set_S},
                           Part{R, s->n_u, s->n_u, d_ocp_qp_set_R}, Part{q, s->n_x, 1, d_ocp_qp_set_q},
                           Part{r, s->n_u, 1, d_ocp_qp_set_r}})
    if (!is_empty(part.v) && solver_->fits(is(part.v, part.rows, part.cols)))
      part.set(k, given(part.v), &solver_->qp);
}

void OcpQp::bounds_u(int k, View lower, View upper) noexcept {
  const Stage* s = solver_->stage(k);
  if (!solver_->fits(s != nullptr)) return;
  const auto n = static_cast<Eigen::Index>(s->bounded_u.size());
  if (!solver_->fits(is(lower, n, 1) && is(upper, n, 1))) return;
  d_ocp_qp_set_lbu(k, given(lower), &solver_->qp);
  d_ocp_qp_set_ubu(k, given(upper), &solver_->qp);
}

QpResult OcpQp::solve() noexcept {
  if (std::exchange(solver_->bad_data, false)) return {QpStatus::bad_data, 0};
  d_ocp_qp_ipm_solve(&solver_->qp, &solver_->sol, &solver_->arg, &solver_->ws);
  int status = 0;
  d_ocp_qp_ipm_get_status(&solver_->ws, &status);
  QpResult result;
  d_ocp_qp_ipm_get_iter(&solver_->ws, &result.iterations);
  if (status == SUCCESS) result.status = QpStatus::solved;
  return result;
}

bool OcpQp::control(int k, double* out, Eigen::Index size) const noexcept {
  const Stage* s = solver_->stage(k);
  if (s == nullptr || s->n_u != size) return false;
  d_ocp_qp_sol_get_u(k, &solver_->sol, out);
  return true;
}

bool OcpQp::state(int k, double* out, Eigen::Index size) const noexcept {
  const Stage* s = solver_->stage(k);
  if (s == nullptr || s->n_x != size) return false;
  d_ocp_qp_sol_get_x(k, &solver_->sol, out);
  return true;
}

}  // namespace mrroc::ocp
