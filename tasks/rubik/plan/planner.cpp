#include "tasks/rubik/plan/planner.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "tasks/rubik/plan/search.hpp"

namespace mrroc::rubik {
namespace {

constexpr int kMostTries = 200;  // searches, each after one more motion is known to be blocked
constexpr double kHolding = 0.057;

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
      if (joints.size() != cell.limits(hand).velocity.size() || !joints.allFinite())
        return refused(NoPlan::bad_start, "the joints are not those of the arms");
      if (cell.reserve(hand, joints) < 0)
        return refused(NoPlan::bad_start, "an arm is beyond its limits at the start");
    }
    CellState state{start.joints, {kOpenJaws, kOpenJaws}, start.grasp, false};
    state.jaws[index(start.grasp.hand)] = kHolding;
    if (!cell.is_free(state)) return refused(NoPlan::collision, "the arms touch something at the start");
    return {};
  }

  Planned plan(const PlanStart& start, Order order, const PlanOptions& options) {
    if (Planned no = check(start); no.why != NoPlan::none) return no;
    motions.start_at(start.joints);
    const Node node{start.grasp, {motions.start(Hand::postument), motions.start(Hand::track)}, 0};
    const GraspSearch search(motions, options, std::move(order));
    for (int k = 0; k < kMostTries; ++k) {
      const auto edges = search.run(node);
      if (!edges)
        return k == 0 ? refused(NoPlan::unreachable, "no sequence of grips that both arms reach")
                      : refused(NoPlan::blocked, "on every sequence of grips something is in the way");
      if (auto plan = follow(search, node, *edges, options)) {
        plan->start = start.grasp;
        plan->start_joints = start.joints;
        return {std::move(plan), NoPlan::none, {}};
      }
    }
    return refused(NoPlan::blocked, "no way was found past what is in the way");
  }

  /// @return the plan; nothing: a motion was found to be blocked or longer, so that another sequence may be better
  std::optional<Plan> follow(const GraspSearch& search, Node node, const std::vector<Edge>& edges,
                             const PlanOptions& options) {
    bool as_expected = true;
    for (Node at = node; const Edge& edge : edges) {
      for (const Motion& m : search.motions_of(at, edge)) {
        const double expected = motions.seconds(m);
        const FreeMotion* found = motions.find(m);
        as_expected = as_expected && found && found->seconds < expected + 0.1;
      }
      at = edge.to;
    }
    if (!as_expected) return {};
    Plan plan;
    for (const Edge& edge : edges) {
      plan.steps.push_back(step(search, node, edge, options));
      node = edge.to;
      const Step& s = plan.steps.back();
      plan.seconds += s.seconds;
      plan.regrasps += s.regrasp();
      plan.grips += !s.shows;
      if (s.turn) plan.turns.push_back(*s.turn);
    }
    plan.end = node.grasp;
    for (const Hand hand : kHands) {
      const Stance& s = motions.stance(hand, node.stances[index(hand)]);
      plan.end_joints[index(hand)] = hand == node.grasp.hand ? s.hold : s.back();
      plan.limits[index(hand)] = cell.limits(hand);
    }
    return plan;
  }

  Step step(const GraspSearch& search, const Node& from, const Edge& edge, const PlanOptions& options) {
    const Hand h = from.grasp.hand, w = other(h);
    Step s;
    s.shows = edge.shows;
    s.comes = w;
    s.leaves = edge.comer_leaves ? w : h;
    s.turn = edge.turn;
    s.angle = edge.quarters * std::numbers::pi / 2;
    s.before_grasp = from.grasp;
    s.grasp = edge.shows ? from.grasp : motions.seen_from(w, edge.comer, from.grasp, edge.holder);
    s.after_grasp = edge.to.grasp;
    s.contact[index(h)] = motions.stance(h, edge.holder).hold;
    s.contact[index(w)] =
        edge.shows ? motions.stance(w, from.stances[index(w)]).back() : motions.stance(w, edge.comer).hold;
    const CycleTimes& times = options.times;
    s.seconds = edge.shows ? times.look : times.grip + times.open;
    for (const Motion& m : search.motions_of(from, edge)) {
      const FreeMotion& motion = *motions.find(m);
      if (m.kind == MotionKind::turn) {
        s.seconds += std::abs(s.angle) / times.turn_rate;
        continue;
      }
      s.seconds += motion.seconds;
      if (m.kind == MotionKind::retreat)
        s.retreat = motion;
      else if (motion.seconds > 0)
        s.before.push_back(motion);
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
