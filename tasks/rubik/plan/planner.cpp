#include "tasks/rubik/plan/planner.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "tasks/rubik/plan/multi_turn_selection.hpp"

namespace mrroc::rubik {
namespace {

constexpr int kMostTries = 200;    // searches, each after one more motion is known to be blocked
constexpr double kSurprise = 0.1;  // by which a path may be longer than the straight line [s]

Planned refused(NoPlan why, std::string text) { return {{}, why, std::move(text)}; }

}  // namespace

const char* to_string(NoPlan why) {
  switch (why) {
    case NoPlan::none:
      return "none";
    case NoPlan::bad_start:
      return "bad start";
    case NoPlan::collision:
      return "collision";
    case NoPlan::unreachable:
      return "unreachable";
    case NoPlan::blocked:
      break;
  }
  return "blocked";
}

struct Planner::Impl {
  explicit Impl(const PlanCell& c) : cell(c), motions(c) {}

  /// @return reason why nothing can begin so; empty: it can
  [[nodiscard]] Planned check(const PlanStart& start) const {
    if (!is_valid(start.grasp)) return refused(NoPlan::bad_start, "palm and jaw lie on opposite faces");
    for (const Hand hand : kHands) {
      const AxisVector& joints = start.joints[index(hand)];
      if (joints.size() != cell.limits(hand).motors.velocity.size() || !joints.allFinite())
        return refused(NoPlan::bad_start, "the joints are not those of the arms");
      if (cell.joint_limit_margin(hand, joints) < 0)
        return refused(NoPlan::bad_start, "an arm is beyond its limits at the start");
    }
    CellState state{start.joints, {kOpenJaws, kOpenJaws}, start.grasp, false};
    state.jaws[index(start.grasp.hand)] = kEdge;
    if (!cell.is_free(state)) return refused(NoPlan::collision, "the arms touch something at the start");
    return {};
  }

  Planned plan(const PlanStart& start, PlanGoal goal, const PlanOptions& options) {
    if (Planned no = check(start); no.why != NoPlan::none) return no;
    motions.start_at(start.joints);
    const Node node{start.grasp, {motions.start_class(Hand::postument), motions.start_class(Hand::track)}, 0};
    const std::array<int, 2> postures{motions.start(Hand::postument), motions.start(Hand::track)};
    const GraspSearch search(motions, options, std::move(goal));
    for (int k = 0; k < kMostTries; ++k) {
      const auto edges = search.run(node);
      const auto steps = edges ? select_turns(motions, node, postures, *edges) : std::nullopt;
      if (!steps)
        return k == 0 ? refused(NoPlan::unreachable, "no sequence of grips that both arms reach")
                      : refused(NoPlan::blocked, "on every sequence of grips something is in the way");
      if (!look_for_paths(*steps)) continue;
      Plan plan = assemble(start, *edges, *steps, options);
      return {std::move(plan), NoPlan::none, {}};
    }
    return refused(NoPlan::blocked, "no way was found past what is in the way");
  }

  /// @return whether all paths are free and take the time that was expected: else another sequence may be better
  bool look_for_paths(const std::vector<SelectedStep>& steps) {
    bool as_expected = true;
    for (const SelectedStep& step : steps)
      for (const ArmTransfer& m : step.motions) {
        const double expected = motions.seconds(m);
        const FreeMotion* found = motions.find(m);
        as_expected = as_expected && found && found->seconds < expected + kSurprise;
      }
    return as_expected;
  }

  Plan assemble(const PlanStart& start, const std::vector<Edge>& edges,
                const std::vector<SelectedStep>& selected, const PlanOptions& options) {
    Plan plan;
    plan.start = plan.end = start.grasp;
    plan.start_joints = plan.end_joints = start.joints;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Step s = step(plan.end, edges[k], selected[k], options);
      plan.end = s.after_grasp;
      plan.end_joints = s.shows ? s.contact : s.after;
      plan.seconds += s.seconds;
      plan.regrasps += s.regrasp();
      plan.grips += !s.shows;
      if (s.turn) plan.turns.push_back(*s.turn);
      plan.steps.push_back(s);
    }
    return plan;
  }

  Step step(const Grasp& held, const Edge& edge, const SelectedStep& selected, const PlanOptions& options) {
    const Hand h = held.hand, w = other(h);
    const StepConfigurations& at = selected.configurations;
    Step s;
    s.shows = edge.shows;
    s.comes = w;
    s.leaves = edge.comer_leaves ? w : h;
    s.turn = edge.turn;
    s.angle = selected.quarters * std::numbers::pi / 2;
    s.before_grasp = held;
    s.grasp = edge.shows ? held : motions.seen_from(w, edge.comer, held, edge.holder);
    s.after_grasp = edge.to.grasp;
    for (const Hand hand : kHands)
      s.contact[index(hand)] = motions.configuration(hand, at.meeting[index(hand)]).hold;
    if (edge.shows) {
      s.contact[index(w)] = motions.configuration(w, at.before[index(w)]).back();
      s.R_GC =
          cell.viewing()->T_UG.R.transpose() * cell.forward(h, s.contact[index(h)]).R * cube_in_hand(held).R;
    }
    for (const Hand hand : kHands) {
      const ArmConfiguration& after = motions.configuration(hand, at.after[index(hand)]);
      s.after[index(hand)] = hand == s.leaves ? after.back() : after.hold;
    }
    if (edge.turn) {
      const int from = at.meeting[index(w)];
      if (const auto* away = motions.find({MotionKind::retreat, w, from, from, at.meeting[index(h)]}))
        s.withdrawal = *away;
      s.withdrawn = s.contact;
      s.withdrawn[index(w)] = motions.configuration(w, from).back();
    }
    const CycleTimes& times = options.times;
    s.seconds = edge.shows ? times.look : times.grip + times.open;
    for (const ArmTransfer& m : selected.motions) {
      const FreeMotion& motion = *motions.find(m);
      if (m.kind == MotionKind::turn) {
        s.seconds += std::abs(s.angle) / times.turn_rate;
        continue;
      }
      s.seconds += motion.seconds;
      if (m.kind == MotionKind::retreat)
        s.retreat = motion;
      else if (motion.seconds > 0 || m.kind == MotionKind::carry)
        s.before.push_back(motion);
    }
    if (s.before.size() == 2) {
      const FreeMotion& carry = s.before[0];
      FreeMotion& reach = s.before[1];
      // A holder that stays goes to where it should be: force control has left it a millimetre beside.
      reach.delay =
          carry.seconds > 0 ? motions.delay(selected.motions[0], selected.motions[1]) : std::optional(0.0);
      if (reach.delay) s.seconds -= carry.seconds - *reach.delay;
    }
    return s;
  }

  const PlanCell& cell;
  Motions motions;
};

Planner::Planner(const PlanCell& cell) : impl_(std::make_unique<Impl>(cell)) {}
Planner::~Planner() = default;

Planned Planner::make_plan(const PlanStart& start, std::span<const Move> moves, const PlanOptions& options) {
  return impl_->plan(start, {grouped(moves), false}, options);
}

Planned Planner::make_reading_plan(const PlanStart& start, const PlanOptions& options) {
  return impl_->plan(start, {{}, true}, options);
}

}  // namespace mrroc::rubik
