#include "edp/contact_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

#include "edp/control_law.hpp"

namespace mrroc::edp {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

TipPlant plant_of(const IdealServo&, double, double) {
  return {MatrixXd::Zero(1, 1), VectorXd::Ones(1), 0, 0, VectorXd::Zero(1), 1};
}

TipPlant plant_of(const LagServo& servo, double, double) {
  const double w = 2 * pi * servo.bandwidth;
  TipPlant p;
  p.x = p.motor = 1;  // s = r, x, (x')
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

TipPlant plant_of(const RegulatedDrive& drive, double K, double D) {
  const double push = drive.lever * drive.lever / drive.inertia;
  TipPlant p;  // s = x, x'
  p.A = (MatrixXd(2, 2) << 0, 1, -K * push, -D * push - 1 / drive.time_constant).finished();
  p.b = (VectorXd(2) << 0, drive.speed_gain * drive.lever / drive.time_constant).finished();
  p.dx = (VectorXd(2) << 0, 1).finished();
  return p;
}

TipPlant plant_of(const CompensatedDrive& drive, double K, double D) {
  RegulatedDrive motor;
  motor.speed_gain = drive.model.speed_per_pwm();
  motor.time_constant = drive.model.time_constant() * drive.inertia / drive.model.inertia;
  motor.inertia = drive.inertia;
  motor.lever = drive.lever;
  return plant_of(motor, K, D);
}

/// Leaves a servo the rotor of its drive. @return acceleration of the motor by a force of the links, at the tip [1/kg]
double take_links(ServoModel& servo, double mass) {
  const auto take = [mass](auto& of) {
    if constexpr (requires { of.lever; }) {
      const double rotor = of.inertia - mass * of.lever * of.lever;
      if constexpr (requires { of.time_constant; }) of.time_constant *= rotor / of.inertia;
      of.inertia = rotor;
      return of.lever * of.lever / rotor;
    }
    return 0.;
  };
  return std::visit(take, servo);
}

/// @return rotor and links, s = that of the servo, x, x'
TipPlant elastic_plant(const GearMode& gears, ServoModel servo, double K, double D) {
  const double pushed = take_links(servo, gears.mass);
  const TipPlant m = std::visit([](const auto& of) { return plant_of(of, 0, 0); }, servo);
  const auto n = m.A.rows();
  const double omega = 2 * pi * gears.frequency;
  const double k = gears.mass * omega * omega, d = 2 * gears.damping * gears.mass * omega;
  VectorXd spring = VectorXd::Zero(n + 2);  // its force on the links, of the state
  spring.head(n) = d * m.dx;
  spring[m.x] += k;
  spring.tail(2) << -k, -d;

  TipPlant p;
  p.A = MatrixXd::Zero(n + 2, n + 2);
  p.A.topLeftCorner(n, n) = m.A;
  if (pushed > 0) p.A.row(m.x + 1) -= pushed * spring.transpose();
  p.A(n, n + 1) = 1;
  p.A.row(n + 1) = spring.transpose() / gears.mass;
  p.A.row(n + 1).tail(2) -= Eigen::RowVector2d(K, D) / gears.mass;
  p.b = VectorXd::Zero(n + 2);
  p.b.head(n) = m.b;
  p.b[n + 1] = d * m.dx_input / gears.mass;
  p.x = static_cast<int>(n);
  p.motor = m.x;
  p.dx = VectorXd::Unit(n + 2, n + 1);
  return p;
}

/// Numbers of the state behind `last_x`: what the servo remembers.
int memory_of(const ServoModel& servo) {
  if (std::holds_alternative<RegulatedDrive>(servo)) return 4;
  return std::holds_alternative<CompensatedDrive>(servo) ? 5 : 0;
}

/// IncrementalRegulator::step without its limit. @param m its e, delta, u1, u2
double regulate(const RegulatorCoefficients& k, double e, double* m) {
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
double compensate(const CompensationGains& k, double set_increment, double moved, double* m) {
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

// What the state holds behind the plant and the readings, these with the newest first. A regulator has the
// whole of it, with its own memory at the end, other servos the first two.
enum Rest { filtered, velocity, last_x, own };

}  // namespace

ContactMap::ContactMap(const ContactLoop& loop, double K)
    : loop_(loop), K_(K), D_(loop.contact_damping), unit_(K) {
  plant_ = loop.gears.frequency > 0
               ? elastic_plant(loop.gears, loop.servo, K_, K_ * D_)
               : std::visit([&](const auto& servo) { return plant_of(servo, K_, K_ * D_); }, loop.servo);
  n_ = static_cast<int>(plant_.A.rows());
  history_ = loop.average + loop.delay;
  felt_ = D_ * plant_.dx;
  felt_[plant_.x] += 1;
  felt_input_ = D_ * plant_.dx_input;
  if (loop.gears.frequency > 0) {  // and what accelerates the tool
    unit_ = std::max(K_, 1.0);
    felt_ = (K_ * felt_ + loop.gears.tool * plant_.A.row(plant_.x + 1).transpose()) / unit_;
    felt_input_ = loop.gears.tool * plant_.b[plant_.x + 1] / unit_;
  }
  // The states, the mean force so far, and the input that is held.
  MatrixXd M = MatrixXd::Zero(n_ + 2, n_ + 2);
  M.topLeftCorner(n_, n_) = plant_.A;
  M.topRightCorner(n_, 1) = plant_.b;
  M.block(n_, 0, 1, n_) = felt_.transpose();
  M(n_, n_ + 1) = felt_input_;
  M.row(n_) /= loop.dt;
  over_step_ = MatrixXd(M * loop.dt).exp();
  if (const auto* drive = std::get_if<CompensatedDrive>(&loop.servo))
    gains_ =
        CompensatingRegulator(drive->regulator, drive->model, drive->increments_per_rad, loop.dt).gains();
  const int memory = memory_of(loop.servo);
  size_ = n_ + history_ + (memory > 0 ? own + memory : last_x);
}

MatrixXd ContactMap::matrix() const {
  MatrixXd A(size_, size_);
  for (int k = 0; k < size_; ++k) A.col(k) = step(VectorXd::Unit(size_, k), 0);
  return A;
}

VectorXd ContactMap::step(VectorXd s, double force) const {
  const auto rest = [&](Rest r) -> double& { return s[n_ + history_ + r]; };
  const double mean = s.segment(n_ + loop_.delay, loop_.average).mean();
  const double weight = loop_.low_pass > 0 ? -std::expm1(-2 * pi * loop_.low_pass * loop_.dt) : 1;
  rest(filtered) += weight * (mean - rest(filtered));
  rest(velocity) = axis_velocity(c(force, loop_.inertia, loop_.mobility), unit_ * rest(filtered),
                                 rest(velocity), loop_.dt);
  double input = rest(velocity);
  if (const auto* drive = std::get_if<RegulatedDrive>(&loop_.servo)) {
    const double increments = drive->increments_per_rad / drive->lever;
    const double e = (rest(velocity) * loop_.dt - (s[plant_.motor] - rest(last_x))) * increments;
    input = regulate(drive->regulator, e, &rest(own));
    rest(last_x) = s[plant_.motor];
  } else if (const auto* known = std::get_if<CompensatedDrive>(&loop_.servo)) {
    const double increments = known->increments_per_rad / known->lever;
    input = compensate(gains_, rest(velocity) * loop_.dt * increments,
                       (s[plant_.motor] - rest(last_x)) * increments, &rest(own));
    rest(last_x) = s[plant_.motor];
  }

  VectorXd held(n_ + 2);
  held << s.head(n_), 0, input;
  const VectorXd after = over_step_ * held;
  for (int k = history_ - 1; k > 0; --k) s[n_ + k] = s[n_ + k - 1];
  s.head(n_) = after.head(n_);
  s[n_] = loop_.mean_of_step ? after[n_] : felt_.dot(after.head(n_)) + felt_input_ * input;
  return s;
}

}  // namespace mrroc::edp
