#include "edp/contact_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

#include "edp/control_law.hpp"
#include "edp/whole_arm.hpp"

namespace mrroc::edp {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

TipPlant plant_of(const IdealServo&, double, double) {
  TipPlant p;
  p.A = p.dx = VectorXd::Zero(1);
  p.B = p.x = p.dx_input = VectorXd::Ones(1);
  return p;
}

TipPlant plant_of(const LagServo& servo, double, double) {
  const double w = 2 * pi * servo.bandwidth;
  TipPlant p;
  p.x = VectorXd::Unit(servo.order + 1, 1);  // s = r, x, (x')
  p.dx_input = VectorXd::Zero(1);
  if (servo.order == 1) {
    p.A = (MatrixXd(2, 2) << 0, 0, w, -w).finished();
    p.B = (VectorXd(2) << 1, 0).finished();
    p.dx = (VectorXd(2) << w, -w).finished();
    return p;
  }
  const double d = 2 * servo.damping * w;
  p.A = (MatrixXd(3, 3) << 0, 0, 0, 0, 0, 1, w * w, -w * w, -d).finished();
  p.B = (VectorXd(3) << 1, 0, d * servo.feed_forward).finished();
  p.dx = (VectorXd(3) << 0, 0, 1).finished();
  return p;
}

TipPlant plant_of(const RegulatedDrive& drive, double K, double D) {
  const double push = drive.lever * drive.lever / drive.inertia;
  TipPlant p;  // s = x, x'
  p.A = (MatrixXd(2, 2) << 0, 1, -K * push, -D * push - 1 / drive.time_constant).finished();
  p.B = (VectorXd(2) << 0, drive.speed_gain * drive.lever / drive.time_constant).finished();
  p.x = VectorXd::Unit(2, 0);
  p.dx = VectorXd::Unit(2, 1);
  p.dx_input = VectorXd::Zero(1);
  p.set = VectorXd::Constant(1, drive.increments_per_rad / drive.lever);
  p.encoders = p.set * p.x.transpose();
  return p;
}

TipPlant plant_of(const CompensatedDrive& drive, double K, double D) {
  RegulatedDrive motor;
  motor.speed_gain = drive.model.speed_per_pwm();
  motor.time_constant = drive.model.time_constant() * drive.inertia / drive.model.inertia;
  motor.inertia = drive.inertia;
  motor.lever = drive.lever;
  motor.increments_per_rad = drive.increments_per_rad;
  return plant_of(motor, K, D);
}

/// The same with rigid gears.
TipPlant plant_of(const WholeArm& arm, double K, double D) { return plant_of(arm, GearMode{}, K, D); }

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
  VectorXd spring(n + 2);  // its force on the links, of the state
  spring << k * m.x + d * m.dx, -k, -d;

  TipPlant p;
  p.A = MatrixXd::Zero(n + 2, n + 2);
  p.A.topLeftCorner(n, n) = m.A - pushed * m.dx * spring.head(n).transpose();
  p.A.topRightCorner(n, 2) = -pushed * m.dx * spring.tail(2).transpose();
  p.A(n, n + 1) = 1;
  p.A.row(n + 1) = spring.transpose() / gears.mass;
  p.A.row(n + 1).tail(2) -= Eigen::RowVector2d(K, D) / gears.mass;
  p.B = MatrixXd::Zero(n + 2, 1);
  p.B.topRows(n) = m.B;
  p.B.row(n + 1) = d / gears.mass * m.dx_input.transpose();
  p.x = VectorXd::Unit(n + 2, n);
  p.dx = VectorXd::Unit(n + 2, n + 1);
  p.dx_input = VectorXd::Zero(1);
  p.encoders = MatrixXd::Zero(m.encoders.rows(), n + 2);
  if (m.encoders.rows() > 0) p.encoders.leftCols(n) = m.encoders;
  p.set = m.set;
  p.tool = gears.tool * p.A.row(n + 1).transpose();
  p.tool_input = gears.tool * p.B.row(n + 1).transpose();
  return p;
}

/// @return gains of each motor that has a CompensatingRegulator
std::vector<CompensationGains> gains_of(const ServoModel& servo, double dt) {
  std::vector<CompensationGains> gains;
  const auto add = [&](const CompensationCoefficients& c, const DriveModel& model, double increments) {
    gains.push_back(CompensatingRegulator(c, model, increments, dt).gains());
  };
  if (const auto* one = std::get_if<CompensatedDrive>(&servo))
    add(one->regulator, one->model, one->increments_per_rad);
  if (const auto* arm = std::get_if<WholeArm>(&servo))
    for (const ArmDrive& d : arm->drives) add(d.regulator, d.model, d.increments_per_rad);
  return gains;
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
/// @param behind set position before the step less the measured one @param m its p, v, d, r
double compensate(const CompensationGains& k, double set_increment, double behind, double* m) {
  double &p = m[0], &v = m[1], &d = m[2], &r = m[3];
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
  return u;
}

// What the state holds behind the plant and the readings, these with the newest first: the first two, and of drives one
// number and each regulator's memory. That number is what a RegulatedDrive's encoder read last. Of CompensatingRegulators
// it is the set way of the tip, which tells all their errors: with errors of their own, axes that feel no contact would add
// modes that neither grow nor fade.
enum Rest { filtered, velocity, placed, own };
constexpr int kMemory = 4;  // of either regulator

/// @return a plant with contact, and with what the loop has between servo and tip
TipPlant plant_with(const ContactLoop& loop, double K) {
  const double D = K * loop.contact_damping;
  if (const auto* arm = std::get_if<WholeArm>(&loop.servo)) return plant_of(*arm, loop.gears, K, D);
  if (loop.gears.frequency > 0) return elastic_plant(loop.gears, loop.servo, K, D);
  return std::visit([&](const auto& servo) { return plant_of(servo, K, D); }, loop.servo);
}

}  // namespace

ContactMap::ContactMap(const ContactLoop& loop, double K)
    : loop_(loop),
      gains_(gains_of(loop.servo, loop.dt)),
      unit_(K),
      plant_(plant_with(loop, K)),
      felt_(plant_.felt * (plant_.x + loop.contact_damping * plant_.dx)),
      felt_input_(plant_.felt * loop.contact_damping * plant_.dx_input),
      n_(static_cast<int>(plant_.A.rows())),
      history_(loop.average + loop.delay) {
  if (plant_.tool.size() > 0) {
    unit_ = std::max(K, 1.0);
    felt_ = (K * felt_ + plant_.tool) / unit_;
    felt_input_ = (K * felt_input_ + plant_.tool_input) / unit_;
  }
  // The states, the mean force so far, and the inputs that are held.
  const auto inputs = plant_.B.cols();
  MatrixXd M = MatrixXd::Zero(n_ + 1 + inputs, n_ + 1 + inputs);
  M.topLeftCorner(n_, n_) = plant_.A;
  M.topRightCorner(n_, inputs) = plant_.B;
  M.block(n_, 0, 1, n_) = felt_.transpose() / loop.dt;
  M.block(n_, n_ + 1, 1, inputs) = felt_input_.transpose() / loop.dt;
  over_step_ = MatrixXd(M * loop.dt).exp();
  const int motors = static_cast<int>(plant_.encoders.rows());
  size_ = n_ + history_ + (motors > 0 ? own + kMemory * motors : placed);
}

MatrixXd ContactMap::matrix() const {
  MatrixXd A(size_, size_);
  for (int k = 0; k < size_; ++k) A.col(k) = step(VectorXd::Unit(size_, k), 0);
  return A;
}

VectorXd ContactMap::inputs(VectorXd& s, double velocity) const {
  if (plant_.encoders.rows() == 0) return VectorXd::Constant(1, velocity);
  const VectorXd read = plant_.encoders * s.head(n_);
  double& place = s[n_ + history_ + placed];
  double* memory = &s[n_ + history_ + own];
  const double way = velocity * loop_.dt;
  if (const auto* drive = std::get_if<RegulatedDrive>(&loop_.servo)) {
    const double e = way * plant_.set[0] - (read[0] - place);
    place = read[0];
    return VectorXd::Constant(1, regulate(drive->regulator, e, memory));
  }
  VectorXd duty(read.size());
  for (Eigen::Index k = 0; k < read.size(); ++k)
    duty[k] = compensate(gains_[static_cast<std::size_t>(k)], way * plant_.set[k],
                         place * plant_.set[k] - read[k], memory + kMemory * k);
  place += way;
  return duty;
}

VectorXd ContactMap::step(VectorXd s, double force) const {
  const auto rest = [&](Rest r) -> double& { return s[n_ + history_ + r]; };
  const double mean = s.segment(n_ + loop_.delay, loop_.average).mean();
  const double weight = loop_.low_pass > 0 ? -std::expm1(-2 * pi * loop_.low_pass * loop_.dt) : 1;
  rest(filtered) += weight * (mean - rest(filtered));
  rest(velocity) = axis_velocity(c(force, loop_.inertia, loop_.mobility), unit_ * rest(filtered),
                                 rest(velocity), loop_.dt);
  const VectorXd input = inputs(s, rest(velocity));

  VectorXd held(over_step_.cols());
  held << s.head(n_), 0, input;
  const VectorXd after = over_step_ * held;
  for (int k = history_ - 1; k > 0; --k) s[n_ + k] = s[n_ + k - 1];
  s.head(n_) = after.head(n_);
  s[n_] = loop_.mean_of_step ? after[n_] : felt_.dot(after.head(n_)) + felt_input_.dot(input);
  return s;
}

}  // namespace mrroc::edp
