#include "edp/stability.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

#include "base/fault.hpp"
#include "edp/control_law.hpp"

namespace mrroc::edp {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

constexpr double kStiffest = 1e9;  // [N/m]

/// Continuous motion of the tip: s' = A s + b input, with the tip at position s[x] moving at dx s + dx_input
/// input. The input is the set velocity, of a drive its duty cycle.
struct Plant {
  MatrixXd A;
  VectorXd b;
  int x{};
  VectorXd dx;
  double dx_input{};
};

Plant plant_of(const IdealServo&, double, double) {
  return {MatrixXd::Zero(1, 1), VectorXd::Ones(1), 0, VectorXd::Zero(1), 1};
}

Plant plant_of(const LagServo& servo, double, double) {
  const double w = 2 * pi * servo.bandwidth;
  Plant p;
  p.x = 1;  // s = r, x, (x')
  if (servo.order == 1) {
    p.A = (MatrixXd(2, 2) << 0, 0, w, -w).finished();
    p.b = (VectorXd(2) << 1, 0).finished();
    p.dx = (VectorXd(2) << w, -w).finished();
    return p;
  }
  const double d = 2 * servo.damping * w;
  p.A = (MatrixXd(3, 3) << 0, 0, 0, 0, 0, 1, w * w, -w * w, -d).finished();
  p.b = (VectorXd(3) << 1, 0, d * servo.feed_forward).finished();
  p.dx = (VectorXd(3) << 0, 0, 1).finished();
  return p;
}

Plant plant_of(const RegulatedDrive& drive, double K, double D) {
  const double push = drive.lever * drive.lever / drive.inertia;
  Plant p;  // s = x, x'
  p.A = (MatrixXd(2, 2) << 0, 1, -K * push, -D * push - 1 / drive.time_constant).finished();
  p.b = (VectorXd(2) << 0, drive.speed_gain * drive.lever / drive.time_constant).finished();
  p.dx = (VectorXd(2) << 0, 1).finished();
  return p;
}

Plant plant_of(const CompensatedDrive& drive, double K, double D) {
  RegulatedDrive motor;
  motor.speed_gain = drive.model.speed_per_pwm();
  motor.time_constant = drive.model.time_constant() * drive.inertia / drive.model.inertia;
  motor.inertia = drive.inertia;
  motor.lever = drive.lever;
  return plant_of(motor, K, D);
}

/// Numbers of the state behind `last_x`: what the servo remembers.
int memory_of(const ServoModel& servo) {
  if (std::holds_alternative<RegulatedDrive>(servo)) return 4;
  return std::holds_alternative<CompensatedDrive>(servo) ? 5 : 0;
}

/// The loop as a map of its state from step to step. The map is linear, so its matrix is what it makes of the
/// unit vectors. Forces in it are per stiffness: numbers of one size let the eigenvalues be found exactly.
class StepMap {
 public:
  StepMap(const ContactLoop& loop, double K) : loop_(loop), K_(K), D_(loop.contact_damping) {
    plant_ = std::visit([&](const auto& servo) { return plant_of(servo, K_, K_ * D_); }, loop.servo);
    n_ = static_cast<int>(plant_.A.rows());
    history_ = loop.average + loop.delay;
    // The states, the mean force so far, and the input that is held.
    MatrixXd M = MatrixXd::Zero(n_ + 2, n_ + 2);
    M.topLeftCorner(n_, n_) = plant_.A;
    M.topRightCorner(n_, 1) = plant_.b;
    M.block(n_, 0, 1, n_) = D_ * plant_.dx.transpose();
    M(n_, plant_.x) += 1;
    M(n_, n_ + 1) = D_ * plant_.dx_input;
    M.row(n_) /= loop.dt;
    over_step_ = MatrixXd(M * loop.dt).exp();
    if (const auto* drive = std::get_if<CompensatedDrive>(&loop.servo))
      gains_ =
          CompensatingRegulator(drive->regulator, drive->model, drive->increments_per_rad, loop.dt).gains();
  }

  [[nodiscard]] MatrixXd matrix() const {
    const int memory = memory_of(loop_.servo);
    const int size = n_ + history_ + (memory > 0 ? own + memory : last_x);
    MatrixXd A(size, size);
    for (int k = 0; k < size; ++k) A.col(k) = step(VectorXd::Unit(size, k));
    return A;
  }

 private:
  // What the state holds behind the plant and the readings, these with the newest first. A regulator has the
  // whole of it, with its own memory at the end, other servos the first two.
  enum Rest { filtered, velocity, last_x, own };

  [[nodiscard]] VectorXd step(VectorXd s) const {
    const auto rest = [&](Rest r) -> double& { return s[n_ + history_ + r]; };
    const double mean = s.segment(n_ + loop_.delay, loop_.average).mean();
    const double weight = loop_.low_pass > 0 ? -std::expm1(-2 * pi * loop_.low_pass * loop_.dt) : 1;
    rest(filtered) += weight * (mean - rest(filtered));
    rest(velocity) =
        axis_velocity(c(0, loop_.inertia, loop_.mobility), K_ * rest(filtered), rest(velocity), loop_.dt);
    double input = rest(velocity);
    if (const auto* drive = std::get_if<RegulatedDrive>(&loop_.servo)) {
      const double increments = drive->increments_per_rad / drive->lever;
      const double e = (rest(velocity) * loop_.dt - (s[plant_.x] - rest(last_x))) * increments;
      input = regulate(drive->regulator, e, &rest(own));
      rest(last_x) = s[plant_.x];
    } else if (const auto* known = std::get_if<CompensatedDrive>(&loop_.servo)) {
      const double increments = known->increments_per_rad / known->lever;
      input = compensate(gains_, rest(velocity) * loop_.dt * increments,
                         (s[plant_.x] - rest(last_x)) * increments, &rest(own));
      rest(last_x) = s[plant_.x];
    }

    VectorXd held(n_ + 2);
    held << s.head(n_), 0, input;
    const VectorXd after = over_step_ * held;
    for (int k = history_ - 1; k > 0; --k) s[n_ + k] = s[n_ + k - 1];
    s.head(n_) = after.head(n_);
    s[n_] = loop_.mean_of_step
                ? after[n_]
                : after[plant_.x] + D_ * (plant_.dx.dot(after.head(n_)) + plant_.dx_input * input);
    return s;
  }

  /// IncrementalRegulator::step without its limit. @param m its e, delta, u1, u2
  static double regulate(const RegulatorCoefficients& k, double e, double* m) {
    const double next = m[1] + (1 + k.epsilon) * e - (1 - k.epsilon) * m[0];
    const double u = (1 + k.a) * m[2] - k.a * m[3] + k.b0 * next - k.b1 * m[1];
    m[0] = e;
    m[1] = next;
    m[3] = m[2];
    m[2] = u;
    return u;
  }

  /// CompensatingRegulator::step without friction and limits.
  /// @param moved motion of the shaft in the step before @param m error, then its p, v, d, r
  static double compensate(const CompensationGains& k, double set_increment, double moved, double* m) {
    const double behind = m[0] - moved;
    double &p = m[1], &v = m[2], &d = m[3], &r = m[4];
    const double surprise = -behind - p;
    p += k.l_p * surprise;
    v += k.l_v * surprise;
    d += k.l_d * surprise;
    const double u =
        (set_increment - k.alpha * r) / ((1 - k.alpha) * k.gain) + k.k_p * (-r / 2 - p) + k.k_v * (r - v) - d;
    const double driving = k.gain * (u + d);
    p += k.beta * v + (1 - k.beta) * driving - set_increment;
    v = k.alpha * v + (1 - k.alpha) * driving;
    r = set_increment;
    m[0] = behind + set_increment;
    return u;
  }

  ContactLoop loop_;
  CompensationGains gains_{};
  double K_, D_;
  Plant plant_;
  int n_{}, history_{};
  MatrixXd over_step_;
};

void check(const CompensatedDrive& drive) {
  const bool good = drive.regulator.bandwidth > 0 && drive.regulator.observer > 0 &&
                    drive.model.resistance > 0 && drive.model.inertia > 0 && drive.increments_per_rad > 0 &&
                    drive.inertia > 0 && drive.lever != 0;
  if (!good)
    throw FaultError(FaultCode::out_of_limits,
                     "stability: a drive needs its regulator, model, increments, inertia and lever");
}

void check(const ContactLoop& loop) {
  const auto demand = [](bool good, const char* what) {
    if (!good) throw FaultError(FaultCode::out_of_limits, std::string("stability: ") + what);
  };
  demand(loop.inertia >= 0 && loop.inertia <= 1e6, "I must lie between 0 and 1e6");
  demand(loop.mobility > 0 && loop.mobility <= 1e3, "B must be above 0, and at most 1000");
  demand(loop.dt > 0 && loop.dt <= 0.1, "dt must be above 0, and at most 0.1 s");
  demand(loop.delay >= 0 && loop.delay <= 20, "the delay must lie between 0 and 20 steps");
  demand(loop.average >= 1 && loop.average <= 20, "the average must lie between 1 and 20 readings");
  demand(loop.low_pass >= 0, "the corner of the low pass must not be negative");
  demand(loop.contact_damping >= 0 && loop.contact_damping <= 1,
         "contact damping must lie between 0 and 1 s");
  if (const auto* lag = std::get_if<LagServo>(&loop.servo)) {
    demand(lag->bandwidth > 0 && lag->bandwidth <= 1e4, "the bandwidth must be above 0, at most 1e4 Hz");
    demand(lag->order == 1 || lag->order == 2, "the order of the servo must be 1 or 2");
    demand(lag->damping > 0 && lag->damping <= 10, "the servo's damping must be above 0, at most 10");
    demand(lag->feed_forward >= 0 && lag->feed_forward <= 1, "feed-forward must lie between 0 and 1");
  }
  if (const auto* drive = std::get_if<RegulatedDrive>(&loop.servo))
    demand(drive->increments_per_rad > 0 && drive->speed_gain > 0 && drive->time_constant > 0 &&
               drive->inertia > 0 && drive->lever != 0,
           "a drive needs increments, gain, time constant, inertia and lever");
  if (const auto* drive = std::get_if<CompensatedDrive>(&loop.servo)) check(*drive);
}

ContactMode mode_of(const ContactLoop& loop, double K) {
  ContactMode worst{.damping = 1};
  for (const std::complex<double>& z : StepMap(loop, K).matrix().eigenvalues()) {
    worst.radius = std::max(worst.radius, std::abs(z));
    if (std::abs(z) < 1e-4) continue;  // gone within a step
    const std::complex<double> s = std::log(z) / loop.dt;
    if (std::abs(s) < 1e-9 || -s.real() / std::abs(s) >= worst.damping) continue;
    worst.damping = -s.real() / std::abs(s);
    worst.frequency = std::abs(s.imag()) / (2 * pi);
  }
  return worst;
}

bool stable(const ContactLoop& loop, double K) { return mode_of(loop, K).radius < 1; }

}  // namespace

ContactMode contact_mode(const ContactLoop& loop, double stiffness) {
  check(loop);
  if (!(stiffness >= 0 && stiffness <= kStiffest))
    throw FaultError(FaultCode::out_of_limits, "stability: the stiffness must lie between 0 and 1e9");
  return mode_of(loop, stiffness);
}

double stiffness_limit(const ContactLoop& loop) {
  check(loop);
  constexpr double kStride = 1.2;
  // Softer contact is slower than rounding can tell from standing still.
  double good = 1e-6 / (loop.mobility * loop.dt);
  if (!stable(loop, good)) return 0;
  double bad = good * kStride;
  while (stable(loop, bad)) {
    good = bad;
    bad *= kStride;
    if (bad > kStiffest) return std::numeric_limits<double>::infinity();
  }
  while (bad / good > 1 + 1e-6) {
    const double middle = std::sqrt(good * bad);
    (stable(loop, middle) ? good : bad) = middle;
  }
  return bad;
}

double mobility_for(ContactLoop loop, double stiffness, double damping) {
  const auto enough = [&](double B) {
    loop.mobility = B;
    return contact_mode(loop, stiffness).damping >= damping;
  };
  constexpr double kLeast = 1e-7, kMost = 10, kStride = 1.1;
  double bad = kMost;
  while (bad > kLeast && !enough(bad / kStride)) bad /= kStride;
  if (bad <= kLeast) return 0;
  double good = bad / kStride;
  while (bad / good > 1 + 1e-4) {
    const double middle = std::sqrt(good * bad);
    (enough(middle) ? good : bad) = middle;
  }
  return good;
}

}  // namespace mrroc::edp
