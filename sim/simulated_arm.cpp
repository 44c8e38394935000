#include "sim/simulated_arm.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/start_joints.hpp"

namespace mrroc::sim {
namespace {

std::unique_ptr<edp::Robot> checked_robot(const ArmParameters& p) {
  if (!p.type) throw std::invalid_argument("world: an arm has no type");
  auto robot = p.type->make(p.model);
  const auto refuse = [&](const std::string& what) {
    throw std::invalid_argument("world: " + std::string(robot->name()) + ": " + what);
  };
  if (static_cast<int>(p.motors.size()) != robot->axes()) refuse("one motor per axis is needed");
  for (const MotorParameters& m : p.motors)
    if (!(m.resistance > 0 && m.rotor_inertia > 0 && m.friction >= 0 && m.presliding > 0 &&
          m.brake_torque > 0))
      refuse("a motor has a resistance, inertia, presliding or brake torque that is not positive");
  if (!(p.paper.stiffness > 0 && p.paper.size > 0 && p.pen_radius > 0))
    refuse("the paper's stiffness and size and the pen's radius must be positive");
  if (p.gripper && !p.jaws) refuse("a gripper's body needs jaws");
  if (p.gripper && p.palm) refuse("it has a gripper or a palm");
  return robot;
}

std::optional<ToolMass> tool_mass(const ArmParameters& p) {
  if (!p.tool) return {};
  return ToolMass{p.tool->weight / kGravity, p.tool->mass_centre};
}

bool usable(const HardwareCommand& command) {
  for (const double pwm : command.pwm)
    if (!std::isfinite(pwm)) return false;
  return command.enabled;
}

}  // namespace

ArmPlan plan_arm(const ArmParameters& p) {
  ArmPlan plan;
  plan.robot = checked_robot(p);
  plan.told_start = sim::start_joints(p);
  const robots::RobotType& type = *p.type;
  // The inertia of the rotors is that at the start.
  const auto inertia = type.rotor_inertia ? type.rotor_inertia : robots::reflected_inertia;
  AxisVector rotors = inertia(*plan.robot, p.motors, plan.told_start);
  if (p.elasticity.frequency > 0) rotors *= kGearShare;  // the others turn by themselves
  plan.chain = read_chain(type.urdf, lengths_of(type, p.model), rotors, tool_mass(p), p.gripper, p.links);
  plan.start = plan.told_start;
  for (int k = 0; k < plan.chain.joints; ++k)
    if (const double error = plan.chain.links[static_cast<std::size_t>(k)].zero_error; error != 0)
      plan.start[k] += error;
  if (p.palm)
    plan.chain.shapes.push_back({"palm",
                                 plan.chain.tool,
                                 Shape::box,
                                 {p.palm->width, p.palm->width, p.palm->thickness},
                                 plan.chain.T_GE * palm_middle(*p.palm)});
  return plan;
}

SimulatedArm::SimulatedArm(const ArmParameters& p, ArmPlan plan, ArmMechanics& body, double h, int substeps,
                           std::uint64_t seed)
    : p_(p),
      body_(body),
      h_(h),
      share_(1.0 / substeps),
      robot_(std::move(plan.robot)),
      T_BU_(p.T_UB.inverse()),
      T_PU_((p.T_UB * p.paper.T_0P).inverse()),
      paper_normal_(T_PU_.R.row(2).transpose()),
      start_joints_(plan.start),
      zero_motors_(robot_->motors_from_joints(plan.start) - robot_->motors_from_joints(plan.told_start)),
      start_motors_(encoded_motors(start_joints_)),
      chain_(std::move(plan.chain)),
      jaw_encoder_(gripper::two_jaw().increments_per_rad, 0.5),
      sensor_(p.sensor, seed),
      hand_(p.hand, p.paper, seed + 1),
      ink_(p.paper) {
  std::mt19937_64 random(seed + 2);
  std::uniform_real_distribution<double> phase(0, 1);
  for (int k = 0; k < chain_.joints; ++k)
    encoders_.emplace_back(robot_->axis(k).increments_per_rad, phase(random));

  if (p.jaws) jaws_.emplace(*p.jaws, h);
  set_object(p.object);
  if (p.elasticity.frequency > 0) add_gears();
  begin_step(nullptr);

  truth_.S_F = body_.weight();
  measure(0);
  observe();
}

void SimulatedArm::add_gears() {
  gears_.emplace(p_.elasticity, body_.at_rest(), p_.motors, robot_->motors_per_joints(start_joints_), h_);
  start_motors_ = encoded_motors(gears_->joints());
}

std::vector<LinkShape> SimulatedArm::shapes() const {
  std::vector<LinkShape> shapes;
  shapes.reserve(chain_.shapes.size());
  for (const BodyShape& s : chain_.shapes) {
    const Pose T_UG = s.body < 0 ? p_.T_UB : body_.link(s.body);
    shapes.push_back({s.link, s.shape, s.size, T_UG * s.T_GV});
  }
  return shapes;
}

AxisVector SimulatedArm::joint_speeds() const {
  AxisVector speeds(chain_.joints);
  for (int k = 0; k < chain_.joints; ++k) speeds[k] = body_.speed(k);
  return speeds;
}

void SimulatedArm::read_joints() {
  truth_.joints.resize(chain_.joints);
  for (int k = 0; k < chain_.joints; ++k) truth_.joints[k] = body_.position(k);
}

void SimulatedArm::begin_step(const HardwareCommand* command) {
  if (command) outputs_ = command->outputs;
  jaw_pwm_ = command ? command->pwm[static_cast<std::size_t>(chain_.joints)] : 0;
  jaws_enabled_ = command && command->jaws_enabled && std::isfinite(jaw_pwm_);
  if (jaws_) jaws_->begin_step();
  read_joints();
  motors_per_joints_ = robot_->motors_per_joints(driven_joints());
  if (command && usable(*command)) {
    command_ = *command;
    body_.open_brakes();
  } else {
    command_ = {};
    if (!gears_) body_.close_brakes(motors_per_joints_);
  }
  reading_.current.fill(0);
  limited_.fill(false);
  truth_.S_F = {};
  truth_.hand_force.setZero();
  truth_.paper_force = 0;
}

AxisVector SimulatedArm::geared(const AxisVector& torques) {
  if (!gears_) return motors_per_joints_.transpose() * torques;
  AxisVector joints(chain_.joints);
  for (int k = 0; k < chain_.joints; ++k) joints[k] = body_.position(k);
  return gears_->step(joints, joint_speeds(), torques, !command_.enabled, motors_per_joints_);
}

void SimulatedArm::push() {
  const AxisVector speeds = gears_ ? gears_->shaft_speeds() : AxisVector(motors_per_joints_ * joint_speeds());
  AxisVector torques(chain_.joints);
  for (int k = 0; k < chain_.joints; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const MotorParameters& m = p_.motors[i];
    LimitedCurrent in{motor_current(m, command_.pwm[i], speeds[k])};
    if (command_.enabled) in = limited_current(m, in.current);  // a braked motor is short-circuited
    limited_[i] = limited_[i] || in.limited;
    torques[k] = motor_torque(m, in.current) + friction_[i].step(m, speeds[k], h_);
    reading_.current[i] += share_ * in.current;
  }
  const AxisVector joint_torques = geared(torques);
  for (int k = 0; k < chain_.joints; ++k) body_.push_joint(k, joint_torques[k]);

  if (jaws_) jaws_->step(jaw_pwm_, jaws_enabled_, share_);
  if (p_.gripper) body_.push_jaws(jaws_->distance());

  const ToolMotion& tool = body_.tool();
  const Vector3 tip_B = T_BU_ * (tool.T_UG * chain_.T_GE.p);
  const Vector3 tip_velocity_B = T_BU_.R * tool.velocity_of(chain_.T_GE.p);
  const bool on_paper = !p_.gripper && !p_.palm && body_.contact_force().dot(paper_normal_) > 0;
  const Vector3 force_B = hand_.step(h_, tip_B, tip_velocity_B, on_paper);
  hand_force_ = p_.T_UB.R * force_B;
  truth_.hand_force += share_ * force_B;
  if (!hand_force_.isZero(0)) body_.push_tip(hand_force_);
}

void SimulatedArm::follow() {
  const Wrench felt = body_.follow(hand_force_);
  // A conveyor has no force sensor: what its driver reads is as of one that nothing touches.
  truth_.S_F += share_ * (p_.type->belt ? body_.weight() : felt);
  if (p_.gripper)
    jaws_->set_load(body_.jaw_force());
  else if (!p_.palm)
    truth_.paper_force += share_ * body_.contact_force().dot(paper_normal_);
}

void SimulatedArm::end_step(std::int64_t step) {
  measure(step);
  observe();
  if (!p_.type->belt)
    ink_.step(truth_.T_0E.p - sheet_way_, truth_.paper_force, static_cast<double>(step) * kStep);
}

void SimulatedArm::measure(std::int64_t step) {
  read_joints();
  const AxisVector motors = encoded_motors(driven_joints());
  reading_.step = step;
  reading_.S_F_m = sensor_.measure(truth_.S_F);
  for (int k = 0; k < chain_.joints; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double before = motors_.size() > 0 ? motors_[k] : motors[k];
    reading_.encoder[i] = encoders_[i].count(motors[k] - start_motors_[k]);
    reading_.index[i] = encoders_[i].count(last_mark(motors[k], before) - start_motors_[k]);
    reading_.switches[i] = read_switches(p_.switches[i], motors[k], before, robot_->axis(k).motor);
    if (limited_[i]) reading_.switches[i] |= static_cast<std::uint8_t>(AxisSwitch::current_limited);
  }
  motors_ = motors;
  if (jaws_) {
    const auto i = static_cast<std::size_t>(chain_.joints);
    reading_.encoder[i] = jaw_encoder_.count(jaws_->turned());
    reading_.current[i] = jaws_->current();
    truth_.jaws = jaws_->distance();
    truth_.jaw_force = jaws_->force();
  }
  reading_.inputs = p_.lines.inputs;
  if (p_.lines.loop_back) reading_.inputs = static_cast<std::uint16_t>(reading_.inputs | outputs_);
}

void SimulatedArm::observe() {
  const ToolMotion& tool = body_.tool();
  truth_.T_0E = T_BU_ * tool.T_UG * chain_.T_GE;
  truth_.tip_velocity = T_BU_.R * tool.velocity_of(chain_.T_GE.p);
  truth_.tool_turn = T_BU_.R * tool.angular_velocity;
  truth_.pen_height = (T_PU_ * (tool.T_UG * chain_.T_GE.p)).z();
}

}  // namespace mrroc::sim
