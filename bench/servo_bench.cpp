// Both algorithms of the servo side by side: the whole simulated arms in contact and in free motion.
#include <fmt/core.h>

#include <cmath>
#include <fstream>
#include <vector>

#include "base/fault.hpp"
#include "base/statistics.hpp"
#include "bench/figures.hpp"
#include "edp/deceleration.hpp"
#include "edp/servo_coefficients.hpp"
#include "mp/gnuplot.hpp"
#include "test/rig/irb6_cell.hpp"
#include "test/sim/driver.hpp"

namespace mrroc::bench {
namespace {

using sim::Cell;

constexpr std::array kFrictions{0.0, 0.010, 0.015, 0.020, 0.030, 0.040, 0.050};  // of the large motors [N m]
constexpr double kFriction = 0.015;                                              // of the documented plant
constexpr std::array kStiffnesses{1e4, 2e4};             // paper, and twice as stiff [N/m]
constexpr std::array kSpeeds{0.0001, 0.001, 0.01, 0.1};  // of the tip [m/s]

struct Contact {
  Statistics rest, slide;  // true force on the paper [N]
};

/// Two arms above their sheets; all motors' friction scaled to that of the large ones.
sim::WorldParameters world_with(double friction, double stiffness) {
  sim::WorldParameters world = rig::irb6_cell();
  for (sim::ArmParameters& arm : world.arms) {
    arm.paper.stiffness = stiffness;
    for (sim::MotorParameters& motor : arm.motors) motor.friction *= friction / kFriction;
  }
  return world;
}

void select(Cell& cell, int algorithm_no) {
  for (sim::Driver& driver : cell.drivers) driver.select(algorithm_no);
}

void all(Cell& cell, const TaskFrameCommand& command) {
  for (sim::Driver& driver : cell.drivers) driver.command = command;
}

TaskFrameCommand along_x(double speed) {
  TaskFrameCommand command{};
  command.x = u(speed);
  return command;
}

void add_forces(Statistics& force, const Cell& cell) {
  for (int arm = 0; arm < cell.world.arms(); ++arm) force.add(cell.world.truth(arm).paper_force);
}

/// 1 N under law (28), at rest and sliding to and fro in eight directions at 20 mm/s.
Contact measure_contact(int algorithm_no, double friction, double stiffness) {
  constexpr int kLeftOut = 100;  // steps at the beginning of a stroke
  Cell cell(world_with(friction, stiffness));
  select(cell, algorithm_no);
  cell.prepare();
  TaskFrameCommand command{};
  command.z = g(0.01, 20, 0.005);
  all(cell, command);
  cell.run(1800);
  command.z = c(1, 20, 0.005);
  all(cell, command);
  cell.run(500);
  Contact contact;
  cell.run(1000, [&] { add_forces(contact.rest, cell); });
  for (int direction = 0; direction < 8; ++direction)
    for (const double speed : {0.02, -0.02}) {
      command.x = u(speed * std::cos(direction * M_PI / 4));
      command.y = u(speed * std::sin(direction * M_PI / 4));
      all(cell, command);
      cell.run(kLeftOut);
      cell.run(400, [&] { add_forces(contact.slide, cell); });
    }
  return contact;
}

/// Largest distance of a tip from its set position at a constant speed [m], and the deviation of its speed [m/s].
struct Tracking {
  double error{}, ripple{};
};
Tracking measure_tracking(int algorithm_no, double speed) {
  Cell cell(world_with(kFriction, kStiffnesses[0]));
  select(cell, algorithm_no);
  cell.run(500);
  all(cell, along_x(speed));
  cell.run(250);
  Tracking tracking;
  Statistics along;
  cell.run(300, [&] {
    for (int arm = 0; arm < cell.world.arms(); ++arm) {
      const sim::ArmTruth& truth = cell.world.truth(arm);
      const Pose& set = cell.drivers[static_cast<std::size_t>(arm)].set_pose();
      tracking.error = std::max(tracking.error, (truth.T_0E.p - set.p).norm());
      along.add(truth.tip_velocity.dot(set.R.col(0)));
    }
  });
  tracking.ripple = along.deviation();
  return tracking;
}

/// What follows when a motion of 50 mm/s is stopped as a driver stops it, without brakes.
struct Stop {
  double overshoot{};  // [m]
  double later{};      // largest speed of a tip from 100 steps after the end of the commands on [m/s]
};
Stop measure_stop(int algorithm_no) {
  constexpr double kSpeed = 0.05;
  Cell cell(world_with(kFriction, kStiffnesses[0]));
  select(cell, algorithm_no);
  cell.run(500);
  all(cell, along_x(kSpeed));
  cell.run(300);
  for (int k = 1; k <= edp::kMaxStopSteps; ++k) {
    all(cell, along_x(kSpeed * edp::remaining_speed(k, edp::kMaxStopSteps)));
    cell.run(1);
  }
  Stop stop;
  int steps = edp::kMaxStopSteps;
  cell.run(400, [&] {
    ++steps;
    for (int arm = 0; arm < cell.world.arms(); ++arm) {
      const sim::ArmTruth& truth = cell.world.truth(arm);
      const Pose& set = cell.drivers[static_cast<std::size_t>(arm)].set_pose();
      stop.overshoot = std::max(stop.overshoot, (truth.T_0E.p - set.p).dot(set.R.col(0)));
      if (steps > 100) stop.later = std::max(stop.later, truth.tip_velocity.norm());
    }
  });
  return stop;
}

struct Row {
  double friction;
  std::array<std::array<Contact, kStiffnesses.size()>, edp::kServoAlgorithms> contact;
};

/// The force's deviation over friction, as data, script and picture.
void plot(const std::filesystem::path& folder, const std::vector<Row>& rows) {
  std::filesystem::create_directories(folder);
  std::ofstream script(folder / "servo.gp");
  script
      << "set terminal pngcairo size 900,420 font 'sans,10'\nset output 'servo.png'\n"
         "set multiplot layout 1,2\nset xlabel 'friction of the large motors [N m]'\n"
         "set ylabel 'standard deviation of the force [N]'\nset yrange [0:0.5]\nset grid\nset key top left\n";
  script << "$data << EOD\n";
  for (const Row& row : rows) {
    script << row.friction;
    for (const auto& algorithm : row.contact)
      for (const Contact& contact : algorithm)
        script << ' ' << contact.rest.deviation() << ' ' << contact.slide.deviation();
    script << '\n';
  }
  script << "EOD\n";
  for (std::size_t s = 0; s < kStiffnesses.size(); ++s) {
    script << fmt::format("set title '1 N on {:.0f} N/mm'\nplot", kStiffnesses[s] / 1000);
    for (std::size_t a = 0; a < edp::kServoAlgorithms; ++a) {
      const std::size_t column = 2 + 2 * (kStiffnesses.size() * a + s);
      script << fmt::format(
          " $data using 1:{} with linespoints lt {} dt 2 title 'algorithm {}, at rest',"
          " $data using 1:{} with linespoints lt {} title 'algorithm {}, sliding',",
          column, a + 1, a, column + 1, a + 1, a);
    }
    script << '\n';
  }
  script.close();
  if (!script) throw FaultError(FaultCode::cannot_write, (folder / "servo.gp").string());
  switch (mp::run_gnuplot(folder, "servo.gp")) {
    case mp::GnuplotResult::done:
      break;
    case mp::GnuplotResult::absent:
      fmt::print(stderr, "gnuplot is not installed, so there is a script but no picture\n");
      break;
    case mp::GnuplotResult::stopped:
    case mp::GnuplotResult::failed:
      throw FaultError(FaultCode::internal_error, "gnuplot did not draw servo.gp; see gnuplot.log beside it");
  }
}

}  // namespace

Figures run_servo_group(const std::filesystem::path& plots) {
  Figures figures;
  std::vector<Row> rows;
  for (const double friction : kFrictions) {
    Row row{friction, {}};
    for (int a = 0; a < edp::kServoAlgorithms; ++a)
      for (std::size_t s = 0; s < kStiffnesses.size(); ++s)
        row.contact[static_cast<std::size_t>(a)][s] = measure_contact(a, friction, kStiffnesses[s]);
    rows.push_back(row);
  }
  if (!plots.empty()) plot(plots, rows);
  for (int a = 0; a < edp::kServoAlgorithms; ++a) {
    const auto key = [a](const std::string& rest) { return fmt::format("servo{}_{}", a, rest); };
    for (std::size_t s = 0; s < kStiffnesses.size(); ++s) {
      const std::string on = s == 0 ? "" : "_stiff";
      double rest = 0, slide = 0, range = 0;
      for (const Row& row : rows) {
        const Contact& contact = row.contact[static_cast<std::size_t>(a)][s];
        rest = std::max(rest, contact.rest.deviation());
        slide = std::max(slide, contact.slide.deviation());
        range = std::max(range, contact.slide.most() - contact.slide.least());
        figures.push_back({key(fmt::format("slide_std{}_N_{:02.0f}", on, 1000 * row.friction)),
                           contact.slide.deviation(), "N",
                           fmt::format("1 N, sliding, friction {:.3f} N m", row.friction)});
      }
      const std::string where = fmt::format("on {:.0f} N/mm, worst friction", kStiffnesses[s] / 1000);
      figures.push_back({key("rest_std" + on + "_N"), rest, "N", "1 N, at rest, " + where});
      figures.push_back({key("slide_std" + on + "_N"), slide, "N", "1 N, sliding, " + where});
      figures.push_back({key("slide_range" + on + "_N"), range, "N", "peak to peak of the same"});
    }
    for (const double speed : kSpeeds) {
      const Tracking tracking = measure_tracking(a, speed);
      const std::string at = fmt::format("_{:g}", 1e6 * speed);
      figures.push_back({key("track_um" + at), 1e6 * tracking.error, "um",
                         fmt::format("behind the set tip, free, {:g} mm/s", 1e3 * speed)});
      figures.push_back({key("ripple_um_s" + at), 1e6 * tracking.ripple, "um/s", "deviation of its speed"});
    }
    const Stop stop = measure_stop(a);
    figures.push_back({key("overshoot_um"), 1e6 * stop.overshoot, "um", "after a stop from 50 mm/s"});
    figures.push_back({key("later_mm_s"), 1e3 * stop.later, "mm/s",
                       "largest speed from 100 steps after the last command on, no brakes"});
  }
  return figures;
}

}  // namespace mrroc::bench
