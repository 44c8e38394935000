#include "test/docs/rex_data_flow.hpp"

#include <algorithm>
#include <functional>
#include <iterator>

namespace mrroc::test {
namespace {

using rex_drive::Locomotion;
using rex_drive::Memory;
using X = Locomotion::X;
using Y = Locomotion::Y;
using Row = Motion<Locomotion>;
using Numbers = std::vector<double>;

void put(Numbers& to, const PathPoint& p) { to.insert(to.end(), {p.p.x, p.p.y, p.p.phi, p.v, p.w}); }
void put(Numbers& to, const rex_drive::Trajectory& t) {
  for (const PathPoint& knot : t.knot) put(to, knot);
  to.push_back(t.duration);
}

Numbers plan_of(const Memory& c) {
  Numbers n;
  for (const rex_drive::PlanPoint& point : c.plan) {
    put(n, point.at);
    n.push_back(point.cruise);
  }
  return n;
}
Numbers traj_of(const Memory& c) {
  Numbers n;
  for (const rex_drive::Trajectory& t : c.traj) put(n, t);
  return n;
}
Numbers trajgen_of(const Memory& c) {
  Numbers n{c.trajgen.busy ? 1.0 : 0.0, static_cast<double>(c.trajgen.elapsed)};
  put(n, c.trajgen.at);
  put(n, c.trajgen.found);
  return n;
}
Numbers end_of(const Memory& c) {
  Numbers n;
  put(n, c.end);
  return n;
}
Numbers fragment_of(const Fragment& f) {
  Numbers n{static_cast<double>(f.number)};
  for (const PathPoint& knot : f.knot) put(n, knot);
  return n;
}
Numbers pose_of(const PlanarPose& p, bool valid, std::int64_t step) {
  return {p.x, p.y, p.phi, valid ? 1.0 : 0.0, static_cast<double>(step)};
}
Numbers estimate_of(const PlatformEstimate& e) { return pose_of(e.p, true, e.step); }
Numbers motion_of(const OdometryReading& A) {
  return {A.A[3], A.valid ? 1.0 : 0.0, static_cast<double>(A.step)};
}

/// An input buffer, and how it may change.
struct Input {
  BufferName name;
  std::function<void(X&)> change;
};
const std::vector<Input>& inputs() {
  static const std::vector<Input> list{
      {{"c_c1[plan]", "x.c.plan"},
       [](X& x) {
         if (x.c.plan.empty()) x.c.plan = {{.at = {{9, 9, 0}}, .cruise = 0.5}};
         x.c.plan.front().at.p.y += 0.2;
       }},
      {{"c_c1[traj]", "x.c.traj"},
       [](X& x) {
         if (x.c.traj.empty()) x.c.traj.resize(1);
         for (rex_drive::Trajectory& t : x.c.traj) {
           t.duration += 2;
           t.knot.front().p.x += 0.1;
         }
       }},
      {{"c_c1[trajgen]", "x.c.trajgen"},
       [](X& x) {
         x.c.trajgen.at.p.x += 0.1;
         x.c.trajgen.elapsed += 1;
         x.c.trajgen.found.knot.back().p.x += 0.1;
       }},
      {{"c_c1[new]", "x.c.new_plan"}, [](X& x) { x.c.new_plan = !x.c.new_plan; }},
      {{"-", "x.c.taken"}, [](X& x) { x.c.taken += 1; }},
      {{"-", "x.c.handed"}, [](X& x) { x.c.handed += 1; }},
      {{"-", "x.c.end"},
       [](X& x) {
         x.c.end.p.y += 0.3;
         x.c.end.v = 0.4 - x.c.end.v;
       }},
      {{"-", "x.c.pace"}, [](X& x) { x.c.pace = 0.3; }},
      {{"e_x c_1,1[q~, q~']", "x.e.estimate"},
       [](X& x) {
         x.e.estimate.p.x += 0.1;
         x.e.estimate.step += 10;
         x.e.estimate.covariance[0] += 1;
       }},
      {{"e_x c_1,1[ready]", "x.e.notified"}, [](X& x) { x.e.notified -= 1; }},
      {{"-", "x.e.remaining"}, [](X& x) { x.e.remaining = 500 - x.e.remaining; }},
      {{"-", "x.e.slip"}, [](X& x) { x.e.slip.mu_y = 0.05; }},
      {{"r_x c_1,1[A_4x4]", "x.V"},
       [](X& x) {
         x.V.valid = true;
         x.V.A[3] += 0.01;
       }},
      {{"T_x c_1,2[desired_plan]", "x.T.desired"},
       [](X& x) {
         x.T.desired.number += 1;
         x.T.desired.point[0][1] += 0.3;
       }},
      {{"T_x c_1,3[x^, y^, phi^]", "x.T.map"}, [](X& x) { x.T.map.pose.p.x += 0.1; }},
      {{"-", "x.T.variant"}, [](X& x) { x.T.variant = rex_drive::kPaused; }},
  };
  return list;
}

/// An output buffer.
struct Output {
  const char* function;
  BufferName name;
  std::function<Numbers(const Y&)> value;
  std::function<Numbers(const X&)> before{};  ///< of memory: what it was
};
Output of_memory(const char* paper, const char* here, Numbers (*value)(const Memory&)) {
  return {"f_cc",
          {paper, here},
          [value](const Y& y) { return value(y.c); },
          [value](const X& x) { return value(x.c); }};
}
const std::vector<Output>& outputs() {
  static const std::vector<Output> list{
      of_memory("c_c1[plan]", "y.c.plan", plan_of),
      of_memory("c_c1[traj]", "y.c.traj", traj_of),
      of_memory("c_c1[trajgen]", "y.c.trajgen", trajgen_of),
      of_memory("c_c1[new]", "y.c.new_plan", [](const Memory& c) { return Numbers{c.new_plan ? 1.0 : 0.0}; }),
      of_memory("-", "y.c.taken", [](const Memory& c) { return Numbers{static_cast<double>(c.taken)}; }),
      of_memory("-", "y.c.handed", [](const Memory& c) { return Numbers{static_cast<double>(c.handed)}; }),
      of_memory("-", "y.c.end", end_of),
      of_memory("-", "y.c.pace", [](const Memory& c) { return Numbers{c.pace}; }),
      {"f_ce",
       {"e_y c_1,1[x^, y^, phi^]", "y.e.map"},
       [](const Y& y) { return pose_of(y.e.map.p, y.e.map.valid, y.e.map.step); }},
      {"f_ce", {"e_y c_1,1[A_4x4]", "y.e.odometry"}, [](const Y& y) { return motion_of(y.e.odometry); }},
      {"f_ce",
       {"e_y c_1,1[traj]", "y.e.fragment.knot"},
       [](const Y& y) { return fragment_of(y.e.fragment); }},
      {"f_ce",
       {"e_y c_1,1[steps]", "y.e.fragment.steps"},
       [](const Y& y) { return Numbers{static_cast<double>(y.e.fragment.steps)}; }},
      {"f_ce",
       {"e_y c_1,1[notify]", "y.e.fragment.notify"},
       [](const Y& y) { return Numbers{static_cast<double>(y.e.fragment.notify)}; }},
      {"f_ce", {"-", "y.e.pace"}, [](const Y& y) { return Numbers{y.e.pace}; }},
      {"f_cT",
       {"T_y c_1,2[ack]", "y.T.event"},
       [](const Y& y) { return Numbers{static_cast<double>(y.T.event)}; }},
      {"f_cT", {"T_y c_1,3[q~, q~']", "y.T.estimate"}, [](const Y& y) { return estimate_of(y.T.estimate); }},
  };
  return list;
}

// --- images to try --------------------------------------------------------------------------------------------

/// A platform that knows its position, and has been handed three fragments of plan 4.
X at_work() {
  X x;
  x.c = rex_drive::begin({});
  x.c.taken = 4;
  x.c.handed = 3;
  x.c.end = {{2, 1, 0}, 0.4, 0};
  x.e.position_known = true;
  x.e.notified = 3;
  x.e.remaining = 0;
  x.e.estimate.p = {2, 1, 0};
  x.e.estimate.step = 1000;
  x.T.desired = {.number = 4, .n = 3, .point = {{{2.5, 1.1}, {3, 1.5}, {3.2, 2}}}, .speed = 0.5};
  x.V.step = 1000;
  x.T.map.pose.valid = true;
  return x;
}

rex_drive::Route two_points() {
  return {{.at = {{3, 1, 0}, 0.4, 0}, .cruise = 0.4, .index = 1},
          {.at = {{3.5, 1, 0}}, .cruise = 0.4, .index = 2}};
}

std::vector<rex_drive::Trajectory> fragments(std::size_t n) {
  std::vector<rex_drive::Trajectory> list(n);
  for (rex_drive::Trajectory& t : list) {
    t.duration = 2;
    for (PathPoint& knot : t.knot) knot.v = 0.4;
  }
  return list;
}

/// A planner that has planned the way to the point before those, or needs another macrostep.
rex_drive::Trajgen planning(const X& x, bool done) {
  const rex_drive::PlanPoint point{.at = {{2.5, 1, 0}, 0.4, 0}, .cruise = 0.4};
  rex_drive::Trajgen trajgen = trajgen_start(trajgen_init(x.c.trajgen, x.c.end), point);
  trajgen.elapsed = done ? trajgen.k.planning : trajgen.k.planning - 1;
  return trajgen;
}

/// What can be made of one image: the driver is ready or not, the way goes on or has ended, a pause is over.
void add_variants(std::vector<X>& all, const X& x) {
  all.push_back(x);
  all.push_back(x);
  all.back().e.notified -= 1;
  all.push_back(x);
  all.back().e.remaining = 500;
  all.push_back(x);
  all.back().c.pace = 0.5;
}

std::vector<X> images() {
  std::vector<X> all;
  const X work = at_work();
  add_variants(all, work);
  X first_plan = work;
  first_plan.c.handed = first_plan.e.notified = 0;
  first_plan.c.taken = 3;
  add_variants(all, first_plan);
  X next_plan = work;
  next_plan.c.taken = 3;
  next_plan.c.traj = fragments(2);
  add_variants(all, next_plan);
  X taken = work;
  taken.c.new_plan = true;
  taken.c.plan = two_points();
  add_variants(all, taken);
  for (const bool done : {false, true})
    for (const std::size_t planned : {0U, 2U}) {
      X under_way = work;
      under_way.c.plan = two_points();
      under_way.c.traj = fragments(planned);
      under_way.c.trajgen = planning(under_way, done);
      add_variants(all, under_way);
      for (rex_drive::Trajectory& t : under_way.c.traj) t.knot.front().v = 0;  // it begins at rest
      if (planned > 0) add_variants(all, under_way);
    }
  return all;
}

Y tried(const Row& row, const X& x) { return {row.f_cc(x), row.f_ce(x), row.f_cV(x), row.f_cT(x)}; }

/// What one output of a row turns out to be made of.
Flow flow_of(const Row& row, const Output& output) {
  return {.m = row.m,
          .function = output.function,
          .output = output.name,
          .inputs = {},
          .kept = static_cast<bool>(output.before)};
}

/// Tries one input of a row in all images. @param flows  of the row's outputs, in their order
void try_input(const Row& row, const Input& input, const std::vector<X>& all, std::vector<Flow>& flows) {
  std::vector<bool> changes(flows.size());
  for (const X& x : all) {
    X changed = x;
    input.change(changed);
    const Y before = tried(row, x), after = tried(row, changed);
    for (std::size_t k = 0; k < flows.size(); ++k)
      if (outputs()[k].value(before) != outputs()[k].value(after)) changes[k] = true;
  }
  for (std::size_t k = 0; k < flows.size(); ++k)
    if (changes[k]) flows[k].inputs.push_back(input.name);
}

std::vector<Flow> flows_of(const Row& row) {
  const std::vector<X> all = images();
  std::vector<Flow> flows;
  for (const Output& output : outputs()) {
    flows.push_back(flow_of(row, output));
    for (const X& x : all)
      if (flows.back().kept) flows.back().kept = output.value(tried(row, x)) == output.before(x);
  }
  for (const Input& input : inputs()) try_input(row, input, all, flows);
  return flows;
}

}  // namespace

std::vector<Flow> data_flows() {
  std::vector<Flow> all;
  for (const Row& row : rex_drive::kBehaviours) std::ranges::move(flows_of(row), std::back_inserter(all));
  return all;
}

}  // namespace mrroc::test
