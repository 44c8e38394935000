#include "tasks/rex_drive/planner/survey.hpp"

namespace mrroc::rex_drive {

PlannerSurvey survey(const std::vector<Plan>& plans, const PlanarPose& start, const PlannerParameters& k) {
  PlannerSurvey result;
  PathPoint at{start};
  for (const Plan& plan : plans)
    for (const PlanPoint& point : proc(plan, at, k.route)) {
      const Leg leg = plan_leg(at, point, k);
      if (!leg.found) {
        result.missed = {plan.number, point.index, point.at.p};
        return result;
      }
      at = leg.trajectory.knot.back();
      result.duration += leg.trajectory.duration;
      result.found.push_back({plan.number, leg.trajectory});
    }
  return result;
}

}  // namespace mrroc::rex_drive
