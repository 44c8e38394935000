#include "test/rig/random_motions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/representation.hpp"
#include "ecp/generators/commands.hpp"
#include "robots/catalogue.hpp"
#include "tasks/move/agent.hpp"
#include "tasks/move/config.hpp"
#include "test/rig/driven_arm.hpp"

namespace mrroc::any_motion {
namespace {

constexpr std::array kGenerators{"trapezoid", "polyline", "linear",   "cubic", "quintic",
                                 "nurbs",     "straight", "constant", "hold",  "replay"};
constexpr std::array kSpaces{"motors", "joints", "frame", "xyz_euler_zyz", "xyz_angle_axis"};

/// Writes one motion; all positions are relative, so that any sequence of motions is one.
class Writer {
 public:
  explicit Writer(std::mt19937& random, int axes) : random_(random), axes_(axes) {}

  std::string motion() {
    const std::string generator = one_of(kGenerators);
    std::string text = fmt::format("generator = \"{}\"\n", generator);
    if (generator == "hold") return text + fmt::format("time = {:.2f}\n", between(0.1, 1));
    const bool straight = generator == "straight";
    const std::string space = straight ? kSpaces.at(2 + random_() % 3) : one_of(kSpaces);
    const bool in_space = space != "motors" && space != "joints";
    text += fmt::format("space = \"{}\"\nreference = \"relative\"\n", space);
    if (in_space && random_() % 2 == 0) text += "interpolation = \"tcim\"\n";
    const std::size_t count = generator == "constant" ? 1 : generator == "nurbs" ? 3 : 1 + random_() % 4;
    std::vector<double> numbers;
    for (std::size_t k = 0; k < count; ++k) {
      const auto position = this->position(space);
      numbers.insert(numbers.end(), position.begin(), position.end());
    }
    text += fmt::format("positions = [{}]\n", fmt::join(numbers, ", "));
    const bool spline = generator == "linear" || generator == "cubic" || generator == "quintic";
    if (generator == "replay" || (spline && random_() % 2 == 0)) {
      std::vector<double> times;
      double t = 0;
      for (std::size_t k = 0; k < count; ++k) times.push_back(t += between(1, 3));
      return text + fmt::format("times = [{}]\n", fmt::join(times, ", "));
    }
    if (straight)
      return text + fmt::format("speed = {:.3f}\nramp = {:.3f}\n", between(0.02, 0.2), between(0.1, 1));
    if (generator == "constant") return text + fmt::format("velocity = [{:.3f}]\n", between(0.01, 0.09));
    text +=
        fmt::format("velocity = [{:.3f}]\nacceleration = [{:.3f}]\n", between(0.05, 0.6), between(0.02, 0.4));
    if (generator == "nurbs") text += fmt::format("degree = {}\n", 1 + random_() % 3);
    if ((generator == "trapezoid" || generator == "polyline") && random_() % 2 == 0) text += "pass = true\n";
    return text;
  }

 private:
  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  template <class List>
  std::string one_of(const List& list) {
    return list.at(random_() % list.size());
  }
  std::vector<double> position(const std::string& space) {
    std::vector<double> numbers;
    if (space == "motors" || space == "joints") {
      for (int k = 0; k < axes_; ++k)
        numbers.push_back(space == "motors" ? between(-12, 12) : between(-0.12, 0.12));
      return numbers;
    }
    Vector6 aa;
    for (double& x : aa.head<3>()) x = between(-0.05, 0.05);
    for (double& x : aa.tail<3>()) x = between(-0.1, 0.1);
    const Representation r = space == "frame"           ? Representation::frame
                             : space == "xyz_euler_zyz" ? Representation::xyz_euler_zyz
                                                        : Representation::xyz_angle_axis;
    const PoseNumbers pose = numbers_from_pose(r, pose_from_angle_axis(aa));
    return {pose.begin(), pose.begin() + numbers_used(r, axes_)};
  }

  std::mt19937& random_;
  int axes_;
};

/// The simulated arm as a Port that looks at what it is commanded.
class WatchingPort {
 public:
  explicit WatchingPort(rig::DrivenArm& arm) : port_(arm) {}
  void dispatch(const Motion<Arm>& motion, const Arm::Y& y) {
    if (has(y.e.set, Part::arm) && motion.m == row(Row::move).m) see(y.e.arm);
    port_.dispatch(motion, y);
  }
  Outcome wait() { return port_.wait(); }
  void read(Arm::X& x) const { port_.read(x); }

  /// A motion begins, from rest, at this place.
  void begin(const PlannedMotion& m) {
    at_rest();
    space_ = m.spec.space;
    position_ = per_axis(space_) ? m.path.set_position(0) : ecp::Coordinates();
    pose_ = m.poses.front();
  }
  /// It has ended, at rest.
  void at_rest() {
    if (velocity_.size() > 0) judge(ecp::Coordinates::Zero(velocity_.size()), true);
    velocity_ = ecp::Coordinates();
  }
  Execution seen;

 private:
  void see(const ArmCommand& command) {
    constexpr double T = 0.02;
    const bool relative = command.reference == Reference::relative;
    ecp::Coordinates v;
    if (per_axis(space_)) {
      const ecp::Coordinates numbers = axes_from_numbers(command.pose, static_cast<int>(position_.size()));
      const ecp::Coordinates next = relative ? ecp::Coordinates(position_ + numbers) : numbers;
      v = (next - position_) / T;
      position_ = next;
    } else {
      const Pose given = pose_from_numbers(command.representation, command.pose).value();
      const Pose next = relative ? pose_ * given : given;
      v.resize(6);
      v << (next.p - pose_.p) / T, pose_.R * angle_axis_from_rotation(pose_.R.transpose() * next.R) / T;
      pose_ = next;
    }
    judge(v, false);
  }
  void judge(const ecp::Coordinates& v, bool ends) {
    constexpr double T = 0.02;
    const ecp::Coordinates before =
        velocity_.size() > 0 ? velocity_ : ecp::Coordinates(ecp::Coordinates::Zero(v.size()));
    const ecp::Coordinates a = (v - before) / T;
    double speed = 0, acceleration = 0;
    if (space_ == Representation::motors) {
      speed = v.cwiseAbs().maxCoeff() / 200;
      acceleration = a.cwiseAbs().maxCoeff() / 150;
    } else if (space_ == Representation::joints) {
      speed = v.cwiseAbs().maxCoeff() / 1.5;
      acceleration = a.cwiseAbs().maxCoeff() / 7;
    } else {
      speed = std::max(v.head<3>().norm() / 0.5, v.tail<3>().norm() / 2);
      acceleration = std::max(a.head<3>().norm(), a.tail<3>().norm()) / 5;
    }
    seen.speed = std::max(seen.speed, speed);
    seen.acceleration = std::max(seen.acceleration, acceleration);
    seen.violations += speed > 1 + 1e-5 || acceleration > 1 + 1e-5 ? 1 : 0;
    if (!ends) velocity_ = v;
  }

  rig::DrivenPort<Arm> port_;
  Representation space_{};
  ecp::Coordinates position_, velocity_;
  Pose pose_;
};

/// As the ECP of every task does before it begins: without it the tool's weight is taken for a contact.
void bias_force(rig::DrivenArm& arm) {
  constexpr int kBiasing = 60;  // macrosteps
  arm.send(ecp::bias_force());
  for (int k = 0; k < kBiasing; ++k)
    if (arm.wait() != Outcome::terminated) throw FaultError(arm.fault());
}

}  // namespace

std::string random_motions(std::mt19937& random, const std::string& model) {
  const bool track = model == "irb6_track";
  Writer writer(random, track ? 7 : 6);
  std::string text = "[arm1]\n", motions;
  std::vector<std::string> order;
  for (std::size_t k = 1 + random() % 3; k > 0; --k) {
    order.push_back(fmt::format("m{}", order.size()));
    motions += fmt::format("[arm1.{}]\n{}", order.back(), writer.motion());
  }
  // High above the table.
  std::vector<double> start{0, -1.57, -0.25, 1.45, 1.57, -1.57};
  if (track) start.insert(start.begin(), 0.2);
  for (double& q : start) q += std::uniform_real_distribution<>(-0.05, 0.05)(random);
  text += fmt::format("start = [{}]\n", fmt::join(start, ", "));
  return text + fmt::format("order = [\"{}\"]\n", fmt::join(order, "\", \"")) + motions;
}

Config config_with(const std::string& file, const std::string& model) {
  Config config = Config::parse(
      fmt::format("[robots]\norder = ['arm1']\n[robots.arm1]\nmodel = '{}'\nsynchro = 'known_pose'\n", model),
      "random");
  for (const std::string& setting : settings_of(Config::parse(file, "random.toml"), {"arm1"}))
    config.set(setting);
  return config;
}

Execution execute(const ArmPlan& plan, const std::string& model, std::uint64_t seed) {
  sim::ArmParameters parameters = sim::arm_parameters(*robots::find(model));
  parameters.start.assign(plan.start.begin(), plan.start.end());
  rig::DrivenArm arm(parameters, seed);
  bias_force(arm);
  WatchingPort port(arm);
  Arm::X x;
  port.read(x);
  x.c.plan = std::make_shared<const ArmPlan>(plan);
  const auto run = [&](Row r) {
    if (mrroc::move(row(r), x, port) != Outcome::terminated) throw FaultError(arm.fault());
  };
  run(Row::start);
  run(Row::rest);
  for (x.c.motion = 0; x.c.motion < plan.motions.size(); ++x.c.motion) {
    const PlannedMotion& m = plan.motions[x.c.motion];
    port.begin(m);
    run(Row::move);
    port.at_rest();
    run(Row::rest);
    port.seen.goal_error_mm =
        std::max(port.seen.goal_error_mm, 1e3 * (pose_of(x.e).p - m.poses.back().p).norm());
  }
  return port.seen;
}

}  // namespace mrroc::any_motion
