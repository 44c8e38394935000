#include "tasks/drawing/conveyor.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "ecp/transparent.hpp"

namespace mrroc::drawing {
namespace {

/// The first behaviour of the coordinator in which both arms reproduce.
constexpr int kReproduction = 4;
/// Height of the belt: the sheets lie on it [m].
constexpr double kBeltTop = 0.9064;
/// Of a slower belt it could not be told whether it runs or stands [m/s].
constexpr double kSlowestBelt = 0.01;

bool reproduces(const Belt::X& x) { return x.T.m >= kReproduction || x.T.finished; }

EffectorCommand at_velocity(const Belt::X& x, double velocity) {
  TaskFrameCommand frame;
  frame.y = u(-velocity);  // y of E is against the belt's
  const auto n_s = static_cast<std::uint16_t>(x.c.n_s);
  return ecp::move_arm(frame, {.n_s = n_s, .n_Q = static_cast<std::uint16_t>(n_s - 1)});
}

EffectorCommand stand(const Belt::X& x) { return at_velocity(x, 0); }

EffectorCommand run(const Belt::X& x) {
  return at_velocity(x, BeltSchedule(x.c.speed, x.c.dt * x.c.n_s).velocity(ecp::age(x)));
}

}  // namespace

void add_conveyor_options(CommandLine& line, ConveyorOptions& o) {
  const Option conveyor = line.flag("--conveyor", o.conveyor,
                                    "the sheets lie on a conveyor, which moves instead of the arms along y");
  line.option("--belt-speed", o.belt_speed,
              "the conveyor runs by itself, with starts and stops, and the arms follow it (0.01 to 0.1)")
      .type_name("M/S")
      .excludes(conveyor);
}

std::vector<std::string> conveyor_settings(const ConveyorOptions& o) {
  if (!o.conveyor && !o.belt_speed) return {};
  std::vector<std::string> settings{fmt::format("robots.order=[\"arm1\", \"arm2\", \"{}\"]", kConveyorKey),
                                    fmt::format("table.height={}", kBeltTop),
                                    fmt::format("robots.{0}.model=\"{0}\"", kConveyorKey),
                                    fmt::format("robots.{}.synchro=\"known_pose\"", kConveyorKey)};
  if (o.belt_speed) settings.push_back(fmt::format("task.belt_speed={}", *o.belt_speed));
  return settings;
}

bool has_conveyor(const Config& config) {
  const auto order = config.texts("robots.order", std::vector<std::string>{"arm1", "arm2"});
  return std::ranges::find(order, kConveyorKey) != order.end();
}

double read_belt_speed(const Config& config) {
  if (!has_conveyor(config)) return 0;
  const double speed = config.number("task.belt_speed", 0, {0, 0.1}, "m/s, 0: it moves for the arms");
  if (speed > 0 && speed < kSlowestBelt)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format("--belt-speed {:g} (task.belt_speed): a belt that runs by itself does so with {:g} "
                    "m/s or more; 0: it moves for the arms",
                    speed, kSlowestBelt));
  return speed;
}

BeltSchedule::BeltSchedule(double speed, double macrostep_s) : speed_(speed), macrostep_s_(macrostep_s) {}

double BeltSchedule::velocity(std::int64_t i) const {
  constexpr double kChange = 0.8;  // from rest to speed, and back [s]
  constexpr double kEven = 0.1;    // at speed [s]
  constexpr double kRest = 0.2;    // at either end [s]
  constexpr double kRun = kChange + kEven + kChange + kRest;
  const double t = (static_cast<double>(i) + 0.5) * macrostep_s_;
  const double runs = std::floor(t / kRun);
  const double at = t - runs * kRun;
  const double to_or_fro = std::fmod(runs, 2) == 0 ? speed_ : -speed_;
  const auto rising = [](double share) { return (1 - std::cos(std::numbers::pi * share)) / 2; };
  if (at < kChange) return to_or_fro * rising(at / kChange);
  if (at < kChange + kEven) return to_or_fro;
  if (at < kRun - kRest) return to_or_fro * rising((kRun - kRest - at) / kChange);
  return 0;
}

const Motion<Belt> kBeltStands{0,
                               "stand",
                               ecp::retain<Belt>,
                               ecp::retain<Belt>,
                               stand,
                               ecp::no_sensor<Belt>,
                               ecp::copy_images<Belt::X>,
                               reproduces,
                               "the arms reproduce"};

const Motion<Belt> kBeltRuns{1,
                             "run",
                             ecp::retain<Belt>,
                             ecp::retain<Belt>,
                             run,
                             ecp::no_sensor<Belt>,
                             ecp::copy_images<Belt::X>,
                             ecp::task_is_over<Belt::X>,
                             "the task is over"};

}  // namespace mrroc::drawing
