#include "test/edp/guard_count.hpp"

#include <fmt/core.h>

#include <cstring>
#include <vector>

#include "base/link/decode.hpp"
#include "base/msg/convert.hpp"
#include "test/edp/damaged_command.hpp"

namespace mrroc::edp::test {
namespace {

/// @return whether a command goes through a message of a wrong size
bool decodes_in_a_wrong_size(std::mt19937_64& random, const EffectorCommand& command) {
  const effector_command_t m = to_message(command);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(m.getEncodedSize()));
  m.encode(bytes.data(), 0, m.getEncodedSize());
  const std::size_t size = random() % (2 * bytes.size());
  bytes.resize(size == bytes.size() ? size + 1 : size);
  return link::decode<effector_command_t>(bytes).has_value();
}

/// @return what a driver says about its arm, model and inputs: a copy of it, so that it is not changed by the
///         question
std::vector<std::uint8_t> told(const Rig& rig) {
  Rig copy = rig;
  EffectorCommand c = copy.command(Instruction::get);
  c.number = copy.driver.protocol().expected();
  c.get = Part::arm | Part::robot_model;
  c.get = static_cast<std::uint8_t>(c.get | static_cast<unsigned>(Part::io));
  c.get_representation = c.get_tool_representation = Representation::frame;
  EffectorReply reply = copy.macrostep(c);
  reply.number = reply.expected = 0;  // the protocol's, which has checks of its own
  const effector_reply_t m = to_message(reply);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(m.getEncodedSize()));
  m.encode(bytes.data(), 0, m.getEncodedSize());
  return bytes;
}

bool same(const Rig& a, const Rig& b) {
  const SetPoint& x = a.driver.set_point();
  const SetPoint& y = b.driver.set_point();
  return a.driver.state() == b.driver.state() && x.T_0E.p == y.T_0E.p && x.T_0E.R == y.T_0E.R &&
         x.axes.motors == y.axes.motors && a.last.pwm == b.last.pwm && a.last.outputs == b.last.outputs &&
         a.last.enabled == b.last.enabled && told(a) == told(b);
}

}  // namespace

InvalidCount count_invalid(long commands, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Rig rig;
  rig.synchronise();
  rig.macrostep(rig.velocity({}));
  rig.silence(3);
  Rig twin = rig;
  InvalidCount count;
  for (; count.commands < commands; ++count.commands) {
    EffectorCommand c = rig.set_arm(random_motion(random));
    c.set = Part::arm | Part::io;
    c.outputs = static_cast<std::uint16_t>(random() | 1);
    const int kind = pick(random, 12);
    if (kind == 0) c.session += 1 + static_cast<std::int64_t>(random() % 1000);
    if (kind == 1) c.number += 1 + static_cast<std::int64_t>(random() % 1000);
    if (kind == 2) c.number -= 2 + static_cast<std::int64_t>(random() % 1000);
    if (kind > 3) damage(random, c);
    if (kind < 4) --rig.number;  // nobody's turn
    bool executed = false;
    if (kind == 3) {
      executed = decodes_in_a_wrong_size(random, c);
      rig.macrostep();
    } else {
      const EffectorReply reply = rig.macrostep(c);
      executed = reply.verdict != Verdict::refused || reply.number != c.number;
    }
    twin.macrostep();
    const bool changed = !same(rig, twin) || rig.driver.protocol().expected() != rig.number + 1;
    if ((executed || changed) && count.first.empty())
      count.first = fmt::format("command {} of kind {}", count.commands, kind);
    count.executed += executed;
    count.changed += changed;
  }
  return count;
}

namespace {

/// A driver of any robot with drives that follow at once, and a random hand that commands it.
class Wanderer {
 public:
  Wanderer(const Robot& robot, const DriverParameters& p, std::uint64_t seed)
      : robot_(robot), p_(p), driver_(robot, p), random_(seed) {
    start_ = robot.motors_from_joints(p.synchro_joints);
    command_.session = 1;
    send(Instruction::synchro);
    macrostep();
  }

  SetPointCount wander(long steps) {
    command_.set = static_cast<std::uint8_t>(Part::arm);
    while (count_.steps < steps) {
      // Several commands alike, so that motions become long; now and then silence.
      const int repeat = 1 + pick(random_, 20);
      command_.arm = any_motion();
      for (int k = 0; k < repeat; ++k) {
        if (pick(random_, 12) != 0) send(Instruction::set);
        macrostep();
      }
    }
    return count_;
  }

 private:
  void send(Instruction instruction) {
    command_.instruction = instruction;
    command_.number = driver_.protocol().expected();
    driver_.take(command_);
  }

  void macrostep() {
    do {
      for (const Axis a : kAxes) reading_.S_F_m[a] = force_[a] + uniform(random_, -0.5, 0.5);
      driver_.step(reading_);
      look();
      for (int k = 0; k < robot_.axes(); ++k)
        reading_.encoder[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(std::lround(
            (driver_.set_point().axes.motors[k] - start_[k]) * robot_.axis(k).increments_per_rad));
      ++reading_.step;
    } while (!driver_.at_boundary());
  }

  void look() {
    const SetPoint& set = driver_.set_point();
    ++count_.steps;
    count_.moving += !set.motor_increment.isZero(0);
    bool wrong = false;
    constexpr double kSlack = 1 + 1e-6;
    for (int k = 0; k < last_.motor_increment.size(); ++k) {
      const AxisProperties& axis = robot_.axis(k);
      const double speed = std::abs(set.motor_increment[k]) / p_.dt / axis.max_motor_speed;
      const double acceleration = std::abs(set.motor_increment[k] - last_.motor_increment[k]) /
                                  (p_.dt * p_.dt) / p_.limits.motor_acceleration;
      count_.speed = std::max(count_.speed, speed);
      count_.acceleration = std::max(count_.acceleration, acceleration);
      const double motor = set.axes.motors[k];
      wrong = wrong || speed > kSlack || acceleration > kSlack || motor < axis.motor.lower - 1e-6 ||
              motor > axis.motor.upper + 1e-6;
      if (driver_.state() == DriverState::not_synchronised) continue;
      const double joint = set.axes.joints[k];
      wrong = wrong || joint < axis.joint.lower - 1e-6 || joint > axis.joint.upper + 1e-6;
    }
    wrong = look_at_the_tip(set) > kSlack || wrong;
    count_.violations += wrong;
    last_ = set;
  }

  /// @return greatest speed or acceleration of E, of its limit, as its poses show them
  double look_at_the_tip(const SetPoint& set) {
    const Vector6 way = angle_axis_from_pose(last_.T_0E.inverse() * set.T_0E) / p_.dt;
    const Twist v = Twist::from(way.head<3>(), way.tail<3>());
    const Matrix3 R_0W = last_.T_0E.R * p_.T_WE.R.transpose();
    const Twist before = xi_V(p_.T_WE.inverse(), xi_star(R_0W.transpose(), v_0W_));
    v_0W_ = xi_star(R_0W, xi_V(p_.T_WE, v));
    if (driver_.state() != DriverState::executing) return 0;
    const Limits& limits = p_.limits;
    const double speed =
        std::max(v.linear().norm() / limits.linear_velocity, v.angular().norm() / limits.angular_velocity);
    count_.tip_speed = std::max(count_.tip_speed, speed);
    if (command_.arm.mu == Interpolation::mim) return speed;
    const Twist change = (v - before) * (1 / p_.dt);
    const double acceleration = std::max(change.linear().norm() / limits.linear_acceleration,
                                         change.angular().norm() / limits.angular_acceleration);
    count_.tip_acceleration = std::max(count_.tip_acceleration, acceleration);
    return std::max(speed, acceleration);
  }

  ArmCommand any_motion() {
    const double size = std::pow(10, uniform(random_, -2, 0.3));  // from slow to much too fast
    ArmCommand a;
    a.n_s = static_cast<std::uint16_t>(1 + pick(random_, 30));
    a.n_Q = static_cast<std::uint16_t>(1 + pick(random_, a.n_s + 1));
    a.mu = static_cast<Interpolation>(pick(random_, 3));
    for (const Axis axis : kAxes) a.frame[axis] = random_row(random_, axis >= Axis::ax);
    for (const Axis axis : kAxes) a.frame[axis].velocity *= 5 * size;
    for (const Axis axis : kAxes) force_[axis] = (axis >= Axis::ax ? 1 : 10) * uniform(random_, -1, 1);
    a.reference = Reference::relative;
    const double time = p_.dt * a.n_s;
    if (a.mu == Interpolation::mim) {
      a.representation = Representation::motors;
      for (int k = 0; k < robot_.axes(); ++k)
        a.pose[static_cast<std::size_t>(k)] =
            uniform(random_, -1, 1) * size * robot_.axis(k).max_motor_speed * time;
    } else {
      a.representation = Representation::xyz_angle_axis;
      const Vector3 p = size * p_.limits.linear_velocity * time * random_direction(random_);
      const Vector3 aa = size * p_.limits.angular_velocity * time * random_direction(random_);
      a.pose = {p.x(), p.y(), p.z(), aa.x(), aa.y(), aa.z()};
    }
    return a;
  }

  const Robot& robot_;
  DriverParameters p_;
  Driver driver_;
  std::mt19937_64 random_;
  AxisVector start_;
  HardwareReading reading_{};
  EffectorCommand command_{};
  Wrench force_;
  SetPoint last_;
  Twist v_0W_;  // of the wrist in the last step
  SetPointCount count_;
};

}  // namespace

SetPointCount count_set_points(const Robot& robot, const DriverParameters& parameters, long steps,
                               std::uint64_t seed) {
  return Wanderer(robot, parameters, seed).wander(steps);
}

}  // namespace mrroc::edp::test
