// Compares predictions of edp/stability.hpp with simulations.
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "bench/arm_limits.hpp"
#include "bench/figures.hpp"
#include "edp/stability.hpp"
#include "robots/irb6/parameters.hpp"
#include "robots/irb6/robot_type.hpp"
#include "test/edp/contact_simulation.hpp"
#include "test/sim/one_axis.hpp"
#include "test/sim/pressing_arm.hpp"

namespace mrroc::bench {
namespace {

using edp::ContactLoop;
using edp::stiffness_limit;
using edp::test::limit_between;

constexpr int kRandomLoops = 200;
constexpr int kElasticContacts = 100;
constexpr edp::ServoChoice kOriginal{0, 0};  // the regulators that edp::RegulatedDrive models
constexpr edp::ServoChoice kDefault{1, 0};   // those that edp::CompensatedDrive models
constexpr double kPrecision = 0.01;          // of simulated limits
constexpr double kPress = 8;                 // [N]
constexpr double kSwings = 0.3;         // deviation over the pressing force from which it does not settle
constexpr double kStiff = 1e6;          // where a limit that there is not is looked for [N/m]
constexpr double kPaperDamping = 2e-3;  // of the simulator's contact, per stiffness [s]

double error_pct(double predicted, double simulated) { return 100 * std::abs(predicted / simulated - 1); }

/// Law, servo and spring in the time domain. @param make a random loop  @param most stiffness that is judged [N/m]
/// @return errors [%]
template <class Make>
std::vector<double> random_loops(Make make, double most) {
  std::mt19937_64 random(1);
  std::vector<double> errors;
  while (errors.size() < kRandomLoops) {
    const ContactLoop loop = make(random);
    const double predicted = stiffness_limit(loop);
    if (predicted == 0 || predicted > most) continue;
    const double simulated = edp::test::first_limit(predicted / 2, predicted * 2, kPrecision, [&](double K) {
      return edp::test::ContactSimulation(loop, K).unstable();
    });
    errors.push_back(error_pct(predicted, simulated));
  }
  return errors;
}

/// An axis of the arm that presses, see test/sim/one_axis_contact_test.cpp.
struct PressingAxis {
  std::size_t axis;  // of the arm on its pedestal
  double lever;      // from the axis to the pen while drawing [m]
  double gear;       // there [rad/rad]
};
constexpr std::array kPressingAxes{PressingAxis{0, 0.90, 158}, PressingAxis{1, 0.455, 168},
                                   PressingAxis{2, 0.67, 172}, PressingAxis{3, 0.31, 128}};
struct Law {
  double I, B;
};
constexpr std::array kLaws{Law{20, 0.005}, Law{5, 0.0025}, Law{10, 0.005}, Law{5, 0.01}};

sim::OneAxis one_axis(const PressingAxis& a) {
  sim::OneAxis o{irb6::kPostument.axes[a.axis].properties,
                 sim::arm_parameters(irb6::postument()).motors[a.axis], 0, a.lever / a.gear, 0};
  const edp::RegulatorCoefficients& k = o.axis.servo.incremental[0];
  o.inertia = sim::kStep / std::log(k.b0 / k.b1) / sim::mechanical_time_constant(o.motor, 1);
  return o;
}

edp::RegulatedDrive drive_of(const sim::OneAxis& o) {
  return {o.axis.servo.incremental[0],
          o.axis.increments_per_rad,
          o.motor.supply / kPwmScale / o.motor.torque_constant,
          sim::mechanical_time_constant(o.motor, o.inertia),
          o.inertia,
          o.lever};
}

/// The same axis with the default regulators.
edp::CompensatedDrive default_drive_of(const sim::OneAxis& o) {
  return {o.axis.servo.compensating[0], o.axis.servo.drive, o.axis.increments_per_rad, o.inertia, o.lever};
}

std::vector<double> random_lag_loops() {
  return random_loops([](auto& random) { return edp::test::random_loop(random); }, 1e8);
}

std::vector<double> random_default_loops() {
  return random_loops(
      [](auto& random) {
        const std::size_t axis =
            std::uniform_int_distribution<std::size_t>(0, kPressingAxes.size() - 1)(random);
        return edp::test::random_loop(random, default_drive_of(one_axis(kPressingAxes[axis])));
      },
      1e7);
}

/// Gears of 8 to 15 Hz, half of them behind the default drives, half behind any servo, on a contact of any stiffness and
/// damping: the largest gain B that is stable. @return errors [%]
std::vector<double> elastic_contacts() {
  constexpr double kLeast = 1e-4, kMost = 0.2;  // B that is looked at [s/kg]
  std::mt19937_64 random(3);
  std::vector<double> errors;
  while (errors.size() < kElasticContacts) {
    const std::size_t axis = std::uniform_int_distribution<std::size_t>(0, kPressingAxes.size() - 1)(random);
    ContactLoop loop = errors.size() % 2 == 0
                           ? edp::test::random_loop(random)
                           : edp::test::random_loop(random, default_drive_of(one_axis(kPressingAxes[axis])));
    loop = edp::test::elastic(random, loop);
    const double K = 2e3 * std::pow(50, std::uniform_real_distribution<>(0, 1)(random));
    const auto with = [&](double B) {
      loop.mobility = B;
      return loop;
    };
    const auto predicted_unstable = [&](double B) { return edp::contact_mode(with(B), K).radius >= 1; };
    const double predicted = edp::test::first_limit(kLeast, kMost, 1e-4, predicted_unstable);
    if (predicted < 2 * kLeast || predicted > kMost / 2) continue;
    const double simulated = edp::test::first_limit(predicted / 2, predicted * 2, kPrecision, [&](double B) {
      return edp::test::ContactSimulation(with(B), K).unstable();
    });
    errors.push_back(error_pct(predicted, simulated));
  }
  return errors;
}

/// Whether a force that settles at F_d well below the limit keeps swinging.
class Swing {
 public:
  void add(double force) {
    sum_ += force;
    squares_ += force * force;
    ++n_;
  }
  [[nodiscard]] double deviation() const {
    const double mean = sum_ / n_;
    return std::sqrt(std::max(0.0, squares_ / n_ - mean * mean));
  }

 private:
  double sum_{}, squares_{}, n_{};
};

/// @return whether an axis with the real regulator keeps swinging in contact of this stiffness
bool drive_swings(const sim::OneAxis& axis, int algorithm_no, const ContactLoop& loop, double K) {
  constexpr int kSteps = 6000, kLate = 5000;
  sim::OneAxisRig rig(axis, algorithm_no);
  rig.wall = 0;
  rig.stiffness = K;
  rig.damping = loop.contact_damping * K;
  Swing late;
  for (int k = 0; k < kSteps; ++k) {
    rig.step(c(kPress, loop.inertia, loop.mobility));
    if (k > kLate) late.add(rig.force());
  }
  return late.deviation() > kSwings * kPress;
}

/// The real regulators, motors and encoders; no friction, which is not linear. @return errors [%]
std::vector<double> real_regulators(int algorithm_no) {
  std::vector<double> errors;
  for (const PressingAxis& axis : kPressingAxes)
    for (const Law& law : kLaws) {
      sim::OneAxis o = one_axis(axis);
      o.motor.friction = o.axis.servo.drive.friction = 0;
      ContactLoop loop{.inertia = law.I, .mobility = law.B, .contact_damping = 1e-4, .servo = drive_of(o)};
      if (algorithm_no == 1) loop.servo = default_drive_of(o);
      const double predicted = stiffness_limit(loop);
      if (std::isinf(predicted)) {
        errors.push_back(drive_swings(o, algorithm_no, loop, kStiff) ? 100 : 0);
        continue;
      }
      errors.push_back(error_pct(
          predicted, limit_between(predicted / 10, predicted * 10, kPrecision,
                                   [&](double K) { return drive_swings(o, algorithm_no, loop, K); })));
    }
  return errors;
}

/// @return whether the real driver in the simulator keeps swinging when it presses its pen on such a table
bool arm_swings(const Law& law, edp::ServoChoice servo, double K) {
  sim::WorldParameters w = sim::PressingArm::world_of_one();
  w.arms[0].paper.stiffness = K;
  w.arms[0].start_height = 0.005;
  edp::DriverParameters p = sim::PressingArm::driver_parameters();
  p.servo = servo;
  p.oscillation.softest = 1;  // the law as it is commanded
  sim::PressingArm arm(w, p);
  arm.prepare();
  // Softly down, then the law that is tried.
  for (int k = 0; k < 50; ++k) arm.move({u(), u(), g(0.01, 5, 0.001), u(), u(), u()});
  for (int k = 0; k < 50; ++k) arm.move({u(), u(), c(kPress, 5, 0.001), u(), u(), u()});
  for (int k = 0; k < 150; ++k) arm.move({u(), u(), c(kPress, law.I, law.B), u(), u(), u()});
  Swing late;
  arm.after_each_step = [&] { late.add(arm.force()); };
  for (int k = 0; k < 50; ++k) arm.move({u(), u(), c(kPress, law.I, law.B), u(), u(), u()});
  return late.deviation() > kSwings * kPress;
}

/// The real driver, friction and all, pressing with the pen; predicted for the upper arm's drive, which does
/// most of the way up and down, without friction. @return simulated over predicted limits
std::vector<double> whole_arm(edp::ServoChoice servo) {
  std::vector<double> ratios;
  const sim::OneAxis axis = one_axis(kPressingAxes[2]);
  const edp::ServoModel upper_arm =
      servo.algorithm_no == 0 ? edp::ServoModel(drive_of(axis)) : edp::ServoModel(default_drive_of(axis));
  for (const Law& law : kLaws) {
    const ContactLoop loop{
        .inertia = law.I, .mobility = law.B, .contact_damping = kPaperDamping, .servo = upper_arm};
    const double predicted = stiffness_limit(loop);
    if (std::isinf(predicted)) continue;
    const double simulated = limit_between(predicted / 20, predicted * 20, 0.1,
                                           [&](double K) { return arm_swings(law, servo, K); });
    ratios.push_back(simulated / predicted);
  }
  return ratios;
}

/// @return limit of stiffness of a behaviour on the upper arm, over the stiffness of pen and paper
double margin(const Law& law) {
  constexpr double kPaper = 1e4;  // [N/m]
  const ContactLoop loop{.inertia = law.I,
                         .mobility = law.B,
                         .contact_damping = kPaperDamping,
                         .servo = default_drive_of(one_axis(kPressingAxes[2]))};
  return stiffness_limit(loop) / kPaper;
}

}  // namespace

Figure stability_limit_figure() {
  return {"stability_limit_err_pct",
          std::max(std::ranges::max(random_lag_loops()), std::ranges::max(random_default_loops())), "%",
          "predicted limit of stiffness against the time domain, worst of 200 random loops with any servo "
          "and 200 with "
          "the default one"};
}

Figures run_stability_group(const std::filesystem::path& plots) {
  Figures figures = {
      stability_limit_figure(),
      {"elastic_limit_err_pct", std::ranges::max(elastic_contacts()), "%",
       "predicted limit of the gain B with elastic gears of 8 to 15 Hz against the time domain, worst of "
       "100 random contacts"},
      {"stability_drive_err_pct", std::ranges::max(real_regulators(kDefault.algorithm_no)), "%",
       "the same against the real regulators, motors and encoders without friction, worst of 16"},
      {"stability_drive_err_original_pct", std::ranges::max(real_regulators(kOriginal.algorithm_no)), "%",
       "the same with the original's regulators"},
      {"stability_arm_ratio_min", std::ranges::min(whole_arm(kDefault)), "",
       "limit of the whole arm in the world over the predicted one, smallest"},
      {"stability_arm_ratio_min_original", std::ranges::min(whole_arm(kOriginal)), "",
       "the same with the original's regulators; above 1: friction helps"},
      {"stability_margin_drawing", margin({20, 0.005}), "", "I 20, B 0.005: limit over 1e4 N/m"},
      {"stability_margin_press", margin({5, 0.0025}), "", "I 5, B 0.0025: limit over 1e4 N/m"},
  };
  for (Figure& figure : arm_limit_figures(plots)) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace mrroc::bench
