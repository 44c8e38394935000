#include "sim/bullet/arm.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "sim/bullet/arm_at_rest.hpp"
#include "sim/bullet/convert.hpp"
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

AxisVector brake_torques(const ArmParameters& p) {
  AxisVector torque(static_cast<int>(p.motors.size()));
  for (int k = 0; k < torque.size(); ++k) torque[k] = p.motors[static_cast<std::size_t>(k)].brake_torque;
  return torque;
}

std::optional<ToolMass> tool_mass(const ArmParameters& p, const Scene& scene) {
  if (!p.tool) return {};
  return ToolMass{p.tool->weight / scene.gravity().norm(), p.tool->mass_centre};
}

/// @param joints  at which the inertia of the rotors is taken [rad, track m]
ArmBody build_arm(const ArmParameters& p, const edp::Robot& robot, const AxisVector& joints,
                  const std::optional<ToolMass>& tool) {
  const robots::RobotType& type = *p.type;
  const auto inertia = type.rotor_inertia ? type.rotor_inertia : robots::reflected_inertia;
  AxisVector rotors = inertia(robot, p.motors, joints);
  if (p.elasticity.frequency > 0) rotors *= kGearShare;  // the others turn by themselves
  return build_arm(type.urdf, lengths_of(type, p.model), p.T_UB, rotors, tool, p.gripper, p.links);
}

bool usable(const HardwareCommand& command) {
  for (const double pwm : command.pwm)
    if (!std::isfinite(pwm)) return false;
  return command.enabled;
}

}  // namespace

SimulatedArm::SimulatedArm(const ArmParameters& p, Scene& scene, double h, int substeps, std::uint64_t seed)
    : p_(p),
      scene_(scene),
      h_(h),
      share_(1.0 / substeps),
      robot_(checked_robot(p)),
      T_BU_(p.T_UB.inverse()),
      T_PU_((p.T_UB * p.paper.T_0P).inverse()),
      paper_normal_(T_PU_.R.row(2).transpose()),
      start_joints_(sim::start_joints(p)),
      start_motors_(robot_->motors_from_joints(start_joints_)),
      arm_(build_arm(p, *robot_, start_joints_, tool_mass(p, scene))),
      brakes_(std::make_unique<Brakes>(*arm_.body, brake_torques(p), h)),
      load_(arm_, scene.gravity(), h),
      jaw_encoder_(gripper::two_jaw().increments_per_rad, 0.5),
      sensor_(p.sensor, seed),
      hand_(p.hand, p.paper, seed + 1),
      ink_(p.paper),
      ball_(p.pen_radius),
      touching_(false) {
  std::mt19937_64 random(seed + 2);
  std::uniform_real_distribution<double> phase(0, 1);
  for (int k = 0; k < arm_.joints; ++k)
    encoders_.emplace_back(robot_->axis(k).increments_per_rad, phase(random));

  if (p.jaws) jaws_.emplace(*p.jaws, h);
  set_object(p.object);
  scene_.dynamics().addMultiBody(arm_.body.get());
  if (p.gripper) {
    gripper_ = std::make_unique<GripperBody>(*p.gripper, arm_, scene, h);
    gripper_->place(jaws_->distance());
  } else if (p.type->belt) {
    add_belt(*p.type->belt);
  } else if (p.palm) {
    palm_ = std::make_unique<PalmBody>(*p.palm, arm_, scene);
    arm_.shapes.push_back(palm_shape(*p.palm, arm_));
  } else {
    add_pen();
  }
  set_joints(*arm_.body, start_joints_);
  if (p.elasticity.frequency > 0) add_gears();
  load_.reset();
  scene_.dynamics().addMultiBodyConstraint(brakes_.get());
  brakes_->finalizeMultiDof();
  begin_step(nullptr);

  truth_.S_F = load_.weight();
  measure(0);
  observe();
}

SimulatedArm::~SimulatedArm() {
  scene_.dynamics().removeMultiBodyConstraint(brakes_.get());
  if (collider_) scene_.dynamics().removeCollisionObject(collider_.get());
  gripper_.reset();
  palm_.reset();
  scene_.dynamics().removeMultiBody(arm_.body.get());
}

void SimulatedArm::add_gears() {
  gears_.emplace(p_.elasticity, arm_at_rest(arm_, scene_.gravity()), p_.motors,
                 robot_->motors_per_joints(start_joints_), h_);
  start_motors_ = robot_->motors_from_joints(gears_->joints());
}

void SimulatedArm::add_pen() {
  // The lowest point of the ball is the tip of the tool.
  const Pose T_G_ball = arm_.T_GE * Pose{Matrix3::Identity(), {0, 0, -p_.pen_radius}};
  touching_.addChildShape(to_bullet(T_G_ball), &ball_);
  add_collider(kPenGroup, kPaperGroup);
  collider_->setFriction(p_.paper.friction);
  collider_->setContactStiffnessAndDamping(p_.paper.stiffness, p_.paper.stiffness * p_.paper.damping_ratio);
}

void SimulatedArm::add_belt(const robots::Belt& belt) {
  constexpr double kThickness = 0.05;  // as that of a table [m]
  belt_ = std::make_unique<btBoxShape>(btVector3(belt.width / 2, belt.length / 2, kThickness / 2));
  const Pose T_0_box{Matrix3::Identity(), belt.middle - kThickness / 2 * Vector3::UnitZ()};
  const Pose T_0E = robot_->forward(AxisVector::Zero(arm_.joints)) * p_.type->driver.T_WE;
  touching_.addChildShape(to_bullet(arm_.T_GE * T_0E.inverse() * T_0_box), belt_.get());
  add_collider(kPaperGroup, kPenGroup);
  collider_->setFriction(1);
}

void SimulatedArm::add_collider(int group, int mask) {
  collider_ = std::make_unique<btMultiBodyLinkCollider>(arm_.body.get(), arm_.tool);
  collider_->setCollisionShape(&touching_);
  collider_->setActivationState(DISABLE_DEACTIVATION);
  arm_.body->getLink(arm_.tool).m_collider = collider_.get();
  scene_.dynamics().addCollisionObject(collider_.get(), group, mask);
}

std::vector<LinkShape> SimulatedArm::shapes() const {
  std::vector<LinkShape> shapes;
  shapes.reserve(arm_.shapes.size());
  for (const BodyShape& s : arm_.shapes) {
    const Pose T_UG = s.body < 0 ? p_.T_UB : link_pose(*arm_.body, s.body);
    shapes.push_back({s.link, s.shape, s.size, T_UG * s.T_GV});
  }
  return shapes;
}

AxisVector SimulatedArm::joint_speeds() const {
  AxisVector speeds(arm_.joints);
  for (int k = 0; k < arm_.joints; ++k) speeds[k] = arm_.body->getJointVel(k);
  return speeds;
}

void SimulatedArm::read_joints() {
  truth_.joints.resize(arm_.joints);
  for (int k = 0; k < arm_.joints; ++k) truth_.joints[k] = arm_.body->getJointPos(k);
}

void SimulatedArm::begin_step(const HardwareCommand* command) {
  if (command) outputs_ = command->outputs;
  jaw_pwm_ = command ? command->pwm[static_cast<std::size_t>(arm_.joints)] : 0;
  jaws_enabled_ = command && command->jaws_enabled && std::isfinite(jaw_pwm_);
  if (jaws_) jaws_->begin_step();
  read_joints();
  motors_per_joints_ = robot_->motors_per_joints(driven_joints());
  if (command && usable(*command)) {
    command_ = *command;
    brakes_->open();
  } else {
    command_ = {};
    if (!gears_) brakes_->close(motors_per_joints_);
  }
  reading_.current.fill(0);
  limited_.fill(false);
  truth_.S_F = {};
  truth_.hand_force.setZero();
  truth_.paper_force = 0;
}

AxisVector SimulatedArm::geared(const AxisVector& torques) {
  if (!gears_) return motors_per_joints_.transpose() * torques;
  AxisVector joints(arm_.joints);
  for (int k = 0; k < arm_.joints; ++k) joints[k] = arm_.body->getJointPos(k);
  return gears_->step(joints, joint_speeds(), torques, !command_.enabled, motors_per_joints_);
}

void SimulatedArm::push() {
  const AxisVector speeds = gears_ ? gears_->shaft_speeds() : AxisVector(motors_per_joints_ * joint_speeds());
  AxisVector torques(arm_.joints);
  for (int k = 0; k < arm_.joints; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const MotorParameters& m = p_.motors[i];
    LimitedCurrent in{motor_current(m, command_.pwm[i], speeds[k])};
    if (command_.enabled) in = limited_current(m, in.current);  // a braked motor is short-circuited
    limited_[i] = limited_[i] || in.limited;
    torques[k] = motor_torque(m, in.current) + friction_[i].step(m, speeds[k], h_);
    reading_.current[i] += share_ * in.current;
  }
  const AxisVector joint_torques = geared(torques);
  for (int k = 0; k < arm_.joints; ++k) arm_.body->addJointTorque(k, joint_torques[k]);

  if (jaws_) jaws_->step(jaw_pwm_, jaws_enabled_, share_);
  if (gripper_) gripper_->push(jaws_->distance());

  const ToolMotion& tool = load_.motion();
  const Vector3 tip_B = T_BU_ * (tool.T_UG * arm_.T_GE.p);
  const Vector3 tip_velocity_B = T_BU_.R * tool.velocity_of(arm_.T_GE.p);
  const bool on_paper = !gripper_ && !palm_ && load_.contact_force().dot(paper_normal_) > 0;
  const Vector3 force_B = hand_.step(h_, tip_B, tip_velocity_B, on_paper);
  hand_force_ = p_.T_UB.R * force_B;
  truth_.hand_force += share_ * force_B;
  if (hand_force_.isZero(0)) return;
  arm_.body->addLinkForce(arm_.tool, to_bullet(hand_force_));
  arm_.body->addLinkTorque(arm_.tool, to_bullet((tool.T_UG.R * arm_.T_GE.p).cross(hand_force_)));
}

void SimulatedArm::follow() {
  const Wrench felt = load_.step(hand_force_);
  // A conveyor has no force sensor: what its driver reads is as of one that nothing touches.
  truth_.S_F += share_ * (belt_ ? load_.weight() : felt);
  if (gripper_)
    jaws_->set_load(gripper_->force());
  else if (!palm_)
    truth_.paper_force += share_ * load_.contact_force().dot(paper_normal_);
}

void SimulatedArm::end_step(std::int64_t step) {
  measure(step);
  observe();
  if (!belt_) ink_.step(truth_.T_0E.p - sheet_way_, truth_.paper_force, static_cast<double>(step) * kStep);
}

void SimulatedArm::measure(std::int64_t step) {
  read_joints();
  const AxisVector motors = robot_->motors_from_joints(driven_joints());
  reading_.step = step;
  reading_.S_F_m = sensor_.measure(truth_.S_F);
  for (int k = 0; k < arm_.joints; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double before = motors_.size() > 0 ? motors_[k] : motors[k];
    reading_.encoder[i] = encoders_[i].count(motors[k] - start_motors_[k]);
    reading_.index[i] = encoders_[i].count(last_mark(motors[k], before) - start_motors_[k]);
    reading_.switches[i] = read_switches(p_.switches[i], motors[k], before, robot_->axis(k).motor);
    if (limited_[i]) reading_.switches[i] |= static_cast<std::uint8_t>(AxisSwitch::current_limited);
  }
  motors_ = motors;
  if (jaws_) {
    const auto i = static_cast<std::size_t>(arm_.joints);
    reading_.encoder[i] = jaw_encoder_.count(jaws_->turned());
    reading_.current[i] = jaws_->current();
    truth_.jaws = jaws_->distance();
    truth_.jaw_force = jaws_->force();
  }
  reading_.inputs = p_.lines.inputs;
  if (p_.lines.loop_back) reading_.inputs = static_cast<std::uint16_t>(reading_.inputs | outputs_);
}

void SimulatedArm::observe() {
  const ToolMotion& tool = load_.motion();
  truth_.T_0E = T_BU_ * tool.T_UG * arm_.T_GE;
  truth_.tip_velocity = T_BU_.R * tool.velocity_of(arm_.T_GE.p);
  truth_.tool_turn = T_BU_.R * tool.angular_velocity;
  truth_.pen_height = (T_PU_ * (tool.T_UG * arm_.T_GE.p)).z();
}

}  // namespace mrroc::sim
