// What the planner believes of the platform, compared with the platform itself.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "edp/platform/guard.hpp"
#include "robots/rex/parameters.hpp"
#include "robots/rex/platform_type.hpp"
#include "tasks/rex_drive/config.hpp"
#include "tasks/rex_drive/plan/built_in_plans.hpp"

namespace mrroc::rex_drive {
namespace {

/// @return the trajectory as it is handed over
edp::ValidationError error_of(const Trajectory& t, double lead) {
  Fragment f;
  f.number = 1;
  f.steps = traj_to_steps(t);
  f.notify = traj_to_notify(t, lead);
  f.knot = t.knot;
  return edp::check_fragment(f, rex::type().platform().properties());
}

TEST(PlannersLimits, AreWithinThoseOfThePlatform) {
  EXPECT_LT(PathLimits{}.speed, rex::kMaxSpeed);
  EXPECT_LT(PathLimits{}.turn_rate, rex::kMaxTurnRate);
  EXPECT_LT(PathLimits{}.lateral, rex::kMaxLateralAcceleration);
  EXPECT_GE(kReach, std::hypot(rex::type().plant.length, rex::type().plant.width) / 2);
}

TEST(PlannersLimits, LetTheDriverTakeEveryFragmentOfEveryBuiltInPlan) {
  PlannerParameters fast;
  fast.route.lateral = 1.7;
  fast.route.turn_rate = 2.1;
  for (const std::string_view name : built_in_plan_names())
    for (const auto& [speed, k] :
         {std::pair{0.3, PlannerParameters{}}, {0.6, PlannerParameters{}}, {1.3, fast}}) {
      SCOPED_TRACE(std::string(name) + " at " + std::to_string(speed));
      const PlanList list = built_in_plan(name);
      const PlannerSurvey all = survey(to_messages(list, speed), list.start, k);
      ASSERT_FALSE(all.missed);
      for (const auto& [plan, t] : all.found) {
        const edp::ValidationError wrong = error_of(t, k.lead);
        EXPECT_FALSE(wrong) << "plan " << plan << " point " << t.index << ": " << wrong->text.view();
      }
    }
}

}  // namespace
}  // namespace mrroc::rex_drive
