#include "tasks/haptic/config.hpp"

namespace mrroc::haptic {
namespace {

ChannelParameters read_channel(const Config& config) {
  const Config task = config.section("task");
  ChannelParameters k;
  k.delay = task.number("delay", k.delay, {0, 0.2}, "s each way");
  k.jitter = task.number("jitter", k.jitter, {0, 0.1}, "s more, at most");
  k.loss = task.number("loss", k.loss, {0, 0.5}, "share of packets");
  k.seed = static_cast<std::uint64_t>(config.integer<std::int64_t>("seed", 1, {0, 1'000'000'000}));
  return k;
}

PassivityLaw read_passivity(const Config& task) {
  PassivityLaw k;
  k.control = task.flag("passivity", k.control);
  k.start = task.number("start_energy", k.start, {0, 0.001}, "J");
  k.surplus = task.number("surplus_energy", k.surplus, {0, 1}, "J");
  return k;
}

Compliance read_compliance(const Config& task, const std::string& side, const Compliance& usual) {
  return {.inertia = task.number(side + "_inertia", usual.inertia, {0.5, 50}, "kg"),
          .mobility = task.number(side + "_mobility", usual.mobility, {2e-4, 0.05}, "s/kg")};
}

}  // namespace

Parameters read_parameters(const Config& config) {
  const Config task = config.section("task");
  Parameters k;
  Law& law = k.law;
  law.motion_scale = task.number("motion_scale", law.motion_scale, {0.5, 3}, "slave's way over master's");
  law.force_scale = task.number("force_scale", law.force_scale, {0.1, 5}, "master's force over slave's");
  law.master = read_compliance(task, "master", law.master);
  law.slave = read_compliance(task, "slave", law.slave);
  law.return_rate = task.number("return_rate", law.return_rate, {1, 40}, "1/s");
  law.smoothing = task.number("smoothing", law.smoothing, {0, 0.1}, "s");
  law.catch_up = task.number("catch_up", law.catch_up, {0, 0.1}, "m/s");
  law.most_speed = task.number("most_speed", law.most_speed, {0.02, 0.25}, "m/s");
  law.most_force = task.number("most_force", law.most_force, {5, 60}, "N");
  law.least_force = task.number("least_force", law.least_force, {0.05, 5}, "N");
  law.channel = read_channel(config);
  law.passivity = read_passivity(task);
  law.macrostep = config.number("time.dt", 0.002, {0.002, 0.002}, "s") *
                  config.integer("time.n_s", kPacing.n_s, {kPacing.n_s, kPacing.n_s}, "steps");
  k.fade = task.number("fade", k.fade, {0.1, 5}, "s");
  return k;
}

OperatorPlan read_operator(const Config& config, const Law& law) {
  const Config t = config.section("operator");
  OperatorPlan k;
  k.slave_mobility =
      t.number("slave_mobility", law.slave.mobility, {2e-4, 0.05}, "s/kg, that he expects of the slave");
  k.return_rate = t.number("return_rate", law.return_rate, {1, 40}, "1/s, that he expects of the slave");
  k.speed = t.number("speed", k.speed, {0.005, 0.1}, "m/s");
  k.touch = t.number("touch", k.touch, {0.002, 0.05}, "m/s");
  k.push = t.number("push", k.push, {1, 25}, "N");
  k.circle = t.number("circle", k.circle, {0.005, 0.05}, "m");
  k.hold = t.number("hold", k.hold, {0.5, 10}, "s");
  return k;
}

}  // namespace mrroc::haptic
