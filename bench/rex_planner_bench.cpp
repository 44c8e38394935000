// The trajectory planner of a mobile platform on random plans: whether it finds a way, in which time, and how fast the way
// goes through the joints of plans.
#include <algorithm>
#include <random>
#include <vector>

#include "bench/figures.hpp"
#include "bench/vision.hpp"
#include "tasks/rex_drive/planner/survey.hpp"
#include "test/tasks/rex_drive/random_plans.hpp"

namespace mrroc::bench {
namespace {

using namespace rex_drive;

constexpr int kPlans = 1000;  // scattered points and winding ways, the same number of each
constexpr int kPoints = 12;
constexpr double kWanted = 0.6;  // [m/s]

struct Found {
  int converged{};
  std::vector<double> iterations;
  std::vector<double> ms;  // of each fragment
};

/// Plans one plan, fragment after fragment.
void drive(const Plan& plan, const PlannerParameters& k, Found& found) {
  PathPoint at;
  for (const PlanPoint& point : proc(plan, at, k.route)) {
    const double begun = thread_ms();
    const Leg leg = plan_leg(at, point, k);
    found.ms.push_back(thread_ms() - begun);
    if (!leg.found) return;
    found.iterations.push_back(leg.trajectory.iterations);
    at = leg.trajectory.knot.back();
  }
  ++found.converged;
}

/// @return least speed at the joint of two plans that are one winding way [% of the wanted], mean over ways
double plan_joint_speed(std::mt19937& random) {
  double sum = 0;
  constexpr int kWays = 200;
  for (int n = 0; n < kWays; ++n) {
    const Plan way = winding_plan(random, kPoints, kWanted);
    PlanList list;
    list.plans.resize(2);
    for (int k = 0; k < kPoints; ++k) {
      const auto& p = way.point[static_cast<std::size_t>(k)];
      list.plans[k < kPoints / 2 ? 0 : 1].push_back({p[0], p[1], 0});
    }
    const std::vector<Plan> plans = to_messages(list, kWanted);
    const PlannerSurvey first = survey({plans[0]}, {}, {});
    if (!first.missed) sum += 100 * first.found.back().trajectory.knot.back().v / kWanted;
  }
  return sum / kWays;
}

}  // namespace

Figures rex_planner_figures() {
  std::mt19937 random(1);
  Found found;
  for (int n = 0; n < kPlans / 2; ++n) {
    drive(scattered_plan(random, kPoints, kWanted), {}, found);
    drive(winding_plan(random, kPoints, kWanted), {}, found);
  }
  return {{"planner_converged_pct", 100.0 * found.converged / kPlans, "%",
           "random plans with a trajectory to their end"},
          {"planner_iterations_p95", quantile(found.iterations, 0.95), "", "iterations for a fragment, 95 %"},
          {"planner_cpu_ms_mid", quantile(found.ms, 0.5), "ms", "computing time of a fragment"},
          {"planner_cpu_ms_max", quantile(found.ms, 1), "ms", "computing time of a fragment, largest"},
          {"planner_joint_speed_pct", plan_joint_speed(random), "%",
           "planned speed between plans, of the wanted"}};
}

}  // namespace mrroc::bench
