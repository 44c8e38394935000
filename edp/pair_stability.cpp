#include "edp/pair_stability.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/fault.hpp"
#include "base/latency.hpp"
#include "edp/contact_map.hpp"

namespace mrroc::edp {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ContactLoop with_hand(const PairLoop& pair) {
  ContactLoop master = pair.master;
  master.contact_damping = pair.hand_damping / pair.hand_stiffness;
  return master;
}

/// The pair as a map of its state from macrostep to macrostep.
class PairMap {
 public:
  PairMap(const PairLoop& pair, double K)
      : pair_(pair),
        K_(K),
        dt_(pair.n_s * pair.slave.dt),
        delay_(static_cast<int>(std::lround(pair.delay / dt_))),
        master_(with_hand(pair), pair.hand_stiffness),
        slave_(pair.slave, K),
        slave_at_(master_.size()),
        reports_at_(slave_at_ + slave_.size()),
        there_at_(reports_at_ + report_size * kReports),
        back_at_(there_at_ + delay_ + 1),
        own_at_(back_at_ + delay_ + 1) {}

  [[nodiscard]] MatrixXd matrix() const {
    const int size = own_at_ + own_size;
    MatrixXd A(size, size);
    for (int k = 0; k < size; ++k) A.col(k) = macrostep(VectorXd::Unit(size, k));
    return A;
  }

 private:
  // What an arm's report says of the motion; the newest report stands first. Forces are per stiffness of the wall.
  enum Report : int { x_m, x_s, F_s, report_size };
  // A motion is answered in the motion kLoop later.
  static constexpr int kReports = static_cast<int>(latency::kLoop);
  // The coordinator's memory.
  enum Own { fed, own_size };

  [[nodiscard]] VectorXd macrostep(VectorXd s) const {
    const auto report = [&](int age, Report r) -> double& { return s[reports_at_ + report_size * age + r]; };
    const int oldest = kReports - 1;
    const double before = pair_.motion_scale * s[there_at_ + delay_];
    push(s, there_at_, report(oldest, x_m));
    push(s, back_at_, report(oldest, F_s));
    const double place = pair_.motion_scale * s[there_at_ + delay_];
    double& feed = s[own_at_ + fed];
    feed += dt_ / (dt_ + pair_.smoothing) * ((place - before) / dt_ - feed);
    const double v_d = feed + pair_.return_rate * (place - report(oldest, x_s));
    const double F_d = -pair_.force_scale * K_ * s[back_at_ + delay_];
    for (int age = oldest; age > 0; --age)
      for (const Report r : {x_m, x_s, F_s}) report(age, r) = report(age - 1, r);
    for (int step = 1; step <= pair_.n_s; ++step) {
      s.head(slave_at_) = master_.step(s.head(slave_at_), F_d);
      s.segment(slave_at_, slave_.size()) =
          slave_.step(s.segment(slave_at_, slave_.size()), v_d / pair_.slave.mobility);
      if (step != pair_.n_s - 1) continue;  // n_Q
      report(0, x_m) = master_.position(s.head(slave_at_));
      report(0, x_s) = slave_.position(s.segment(slave_at_, slave_.size()));
      report(0, F_s) = slave_.reading(s.segment(slave_at_, slave_.size()));
    }
    return s;
  }

  /// Puts a number into a line, whose newest number stands first.
  void push(VectorXd& s, int at, double number) const {
    for (int k = delay_; k > 0; --k) s[at + k] = s[at + k - 1];
    s[at] = number;
  }

  PairLoop pair_;
  double K_, dt_;
  int delay_;  // of the channel, in macrosteps
  ContactMap master_, slave_;
  int slave_at_, reports_at_, there_at_, back_at_, own_at_;  // parts of the state
};

void check(const PairLoop& pair) {
  check_loop(with_hand(pair));
  check_loop(pair.slave);
  const auto demand = [](bool good, const char* what) {
    if (!good) throw FaultError(FaultCode::out_of_limits, std::string("stability of a pair: ") + what);
  };
  demand(pair.master.dt == pair.slave.dt, "both arms must have the same dt");
  demand(pair.hand_stiffness >= 1 && pair.hand_stiffness <= 1e6,
         "the stiffness of the hand must lie between 1 and 1e6 N/m");
  demand(pair.hand_damping >= 0 && pair.hand_damping <= pair.hand_stiffness,
         "the damping of the hand must lie between 0 and its stiffness times 1 s");
  demand(pair.motion_scale > 0 && pair.motion_scale <= 100,
         "the scale of motion must lie above 0, at most 100");
  demand(pair.force_scale > 0 && pair.force_scale <= 100, "the scale of force must lie above 0, at most 100");
  demand(pair.return_rate > 0 && pair.return_rate <= 1000,
         "the return rate must lie above 0, at most 1000 1/s");
  demand(pair.smoothing >= 0 && pair.smoothing <= 1, "the smoothing must lie between 0 and 1 s");
  demand(pair.delay >= 0 && pair.delay <= 0.2, "the delay must lie between 0 and 0.2 s");
  demand(pair.n_s >= 2 && pair.n_s <= 20, "n_s must lie between 2 and 20");
}

double radius(const PairLoop& pair, double K) {
  double most = 0;
  for (const std::complex<double>& z : PairMap(pair, K).matrix().eigenvalues())
    most = std::max(most, std::abs(z));
  return most;
}

}  // namespace

double pair_radius(const PairLoop& pair, double stiffness) {
  check(pair);
  if (!(stiffness > 0 && stiffness <= 1e9))
    throw FaultError(FaultCode::out_of_limits,
                     "stability of a pair: the stiffness must lie above 0, at most 1e9");
  return radius(pair, stiffness);
}

bool pair_settles(PairLoop pair, double stiffness, double late) {
  constexpr double kMargin = 1.5, kTime = 2, kLatest = 0.02;  // [s]
  check(pair);
  pair.delay += late;
  if (pair.delay > kLatest) return false;
  const double slowest = std::exp(-pair.n_s * pair.slave.dt / kTime);
  return radius(pair, stiffness) < slowest && radius(pair, kMargin * stiffness) < slowest;
}

double pair_stiffness_limit(const PairLoop& pair) {
  check(pair);
  constexpr double kStride = 1.06, kPrecision = 1.01;  // stiffer walls may be stable again
  double good = kSoftestWall;
  if (radius(pair, good) >= 1) return 0;
  double bad = good * kStride;
  while (radius(pair, bad) < 1) {
    good = bad;
    bad *= kStride;
    if (good > kStiffestWall) return std::numeric_limits<double>::infinity();
  }
  while (bad / good > kPrecision) {
    const double middle = std::sqrt(good * bad);
    (radius(pair, middle) < 1 ? good : bad) = middle;
  }
  return std::sqrt(good * bad);
}

double colgate_bound(const PairLoop& pair) {
  const double T = pair.n_s * pair.master.dt;
  return 2 / (pair.master.mobility * T) / (pair.motion_scale * pair.force_scale);
}

}  // namespace mrroc::edp
