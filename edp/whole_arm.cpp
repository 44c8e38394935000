#include "edp/whole_arm.hpp"

#include <Eigen/Dense>
#include <numbers>

#include "base/fault.hpp"

namespace mrroc::edp {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// @return motion of a point P of the wrist per motion of the joints: way and turn, in the frame of E
MatrixXd jacobian(const Robot& robot, const AxisVector& joints, const Pose& T_WE, const Vector3& W_P) {
  constexpr double kHalf = 1e-5;  // [rad, m]
  const Matrix3 R_E0 = (robot.forward(joints) * T_WE).R.transpose();
  MatrixXd J(6, joints.size());
  for (Eigen::Index k = 0; k < joints.size(); ++k) {
    AxisVector before = joints, behind = joints;
    before[k] -= kHalf;
    behind[k] += kHalf;
    const Pose from = robot.forward(before), to = robot.forward(behind);
    const Matrix3 turn = to.R * from.R.transpose();
    const Vector3 about(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    J.col(k) << R_E0 * (to * W_P - from * W_P), R_E0 * about / 2;
  }
  return J / (2 * kHalf);
}

/// What an arm's motors and links are, of its joints.
struct Masses {
  MatrixXd links, rotors;  // mass matrices; all is with the links when gears are rigid
  MatrixXd stiffness;      // of the gears
  MatrixXd pull, emf;      // torques by duty cycles, and by speeds of the shafts
};

Masses masses_of(const WholeArm& arm, const GearMode& gears) {
  const auto n = static_cast<Eigen::Index>(arm.drives.size());
  const MatrixXd J = arm.motors_per_joints;
  VectorXd rotor(n), pull(n), emf(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const ArmDrive& drive = arm.drives[static_cast<std::size_t>(k)];
    rotor[k] = drive.rotor;
    pull[k] = 1 / drive.model.pwm_per_torque();
    emf[k] = drive.model.torque_constant * drive.model.torque_constant / drive.model.resistance;
  }
  const MatrixXd rotors = J.transpose() * rotor.asDiagonal() * J;
  Masses m;
  m.pull = J.transpose() * pull.asDiagonal();
  m.emf = J.transpose() * emf.asDiagonal() * J;
  if (gears.frequency == 0) {
    m.links = arm.mass + rotors;
    return m;
  }
  m.links = arm.mass + arm.wheels * rotors;
  m.rotors = (1 - arm.wheels) * rotors;
  m.stiffness = (m.links.diagonal() + m.rotors.diagonal()).asDiagonal();
  const double lowest =
      Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(m.stiffness, m.links).eigenvalues()[0];
  const double omega = 2 * std::numbers::pi * gears.frequency;
  m.stiffness *= omega * omega / lowest;
  return m;
}

/// What a plant is to law and regulators. @param driven  first number of what encoders read
TipPlant seen(const WholeArm& arm, const MatrixXd& A, const MatrixXd& B, Eigen::Index driven) {
  const auto n = static_cast<Eigen::Index>(arm.drives.size());
  const MatrixXd J = arm.motors_per_joints;
  VectorXd increments(n);
  for (Eigen::Index k = 0; k < n; ++k)
    increments[k] = arm.drives[static_cast<std::size_t>(k)].increments_per_rad;
  TipPlant p;
  p.A = A;
  p.B = B;
  p.x = p.dx = VectorXd::Zero(A.rows());
  p.x.head(n) = p.dx.segment(n, n) = arm.tip;
  p.felt = arm.felt;
  p.dx_input = VectorXd::Zero(n);
  p.encoders = MatrixXd::Zero(n, A.rows());
  p.encoders.middleCols(driven, n) = increments.asDiagonal() * J;
  p.set = increments.asDiagonal() * J * arm.set;
  p.tool = arm.tool * A.middleRows(n, n).transpose() * arm.tool_centre;
  p.tool_input = arm.tool * B.middleRows(n, n).transpose() * arm.tool_centre;
  return p;
}

}  // namespace

WholeArm whole_arm(const Robot& robot, const ArmBelief& belief) {
  if (robot.axes() != 6) throw FaultError(FaultCode::out_of_limits, "stability: the arm has not six axes");
  const MatrixXd J = jacobian(robot, belief.joints, belief.T_WE, belief.T_WE.p);
  const Eigen::FullPivLU<MatrixXd> inverse(J);
  if (inverse.rcond() < 1e-6)
    throw FaultError(FaultCode::out_of_limits, "stability: the arm is singular there");
  const auto axis = static_cast<Eigen::Index>(belief.axis);
  WholeArm arm;
  for (int k = 0; k < robot.axes(); ++k) {
    const AxisProperties& p = robot.axis(k);
    const auto set = static_cast<std::size_t>(p.servo.standard.parameter_set_no);
    arm.drives.push_back({p.servo.compensating[set], p.servo.drive, p.increments_per_rad, belief.rotors[k]});
  }
  arm.motors_per_joints = robot.motors_per_joints(belief.joints);
  arm.mass = belief.mass;
  const Vector3 along = Vector3::Unit(axis);
  const Vector3 normal = belief.normal.isZero() ? along : belief.normal.normalized();
  arm.tip = J.topRows(3).transpose() * normal;
  arm.felt = normal.dot(along);
  arm.set = inverse.solve(VectorXd::Unit(6, axis));
  arm.tool = belief.tool;
  arm.tool_centre = jacobian(robot, belief.joints, belief.T_WE, belief.tool_centre).row(axis).transpose();
  return arm;
}

TipPlant plant_of(const WholeArm& arm, const GearMode& gears, double K, double D) {
  const auto n = static_cast<Eigen::Index>(arm.drives.size());
  const Masses m = masses_of(arm, gears);
  const MatrixXd felt = arm.tip * arm.tip.transpose();
  const bool rigid = gears.frequency == 0;
  const Eigen::Index size = rigid ? 2 * n : 4 * n;
  MatrixXd A = MatrixXd::Zero(size, size), B = MatrixXd::Zero(size, n);
  A.block(0, n, n, n).setIdentity();
  const Eigen::LLT<MatrixXd> links(m.links);
  if (rigid) {
    A.block(n, 0, n, n) = links.solve(-K * felt);
    A.block(n, n, n, n) = links.solve(-D * felt - m.emf);
    B.bottomRows(n) = links.solve(m.pull);
    return seen(arm, A, B, 0);
  }
  const Eigen::LLT<MatrixXd> rotors(m.rotors);
  const MatrixXd damping = gears.damping / (std::numbers::pi * gears.frequency) * m.stiffness;
  A.block(2 * n, 3 * n, n, n).setIdentity();
  A.middleRows(n, n) << links.solve(-m.stiffness - K * felt), links.solve(-damping - D * felt),
      links.solve(m.stiffness), links.solve(damping);
  A.bottomRows(n) << rotors.solve(m.stiffness), rotors.solve(damping), rotors.solve(-m.stiffness),
      rotors.solve(-damping - m.emf);
  B.bottomRows(n) = rotors.solve(m.pull);
  return seen(arm, A, B, 2 * n);
}

}  // namespace mrroc::edp
