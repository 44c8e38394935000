#include "tasks/calibrate_cell/calibrate_cell.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "ecp/generators/force.hpp"
#include "ecp/generators/straight_path.hpp"
#include "tasks/calibrate_cell/vocabulary.hpp"

namespace mrroc::calibrate_cell {
namespace {

using X = Arm::X;

constexpr ecp::PathLimits kLimits{.velocity = 0.1, .acceleration = 0.4};
constexpr double kSwing = 0.2;  // of the largest speed of the joints, on the way to the balls
constexpr int kContact = 10;    // macrosteps in succession that are more than a bounce
constexpr int kTelling = 100;   // macrosteps in which the coordinator hears of a ball that is not there

const Direction& present(const X& x) { return direction(x.c.done.size()); }

// --- f_cc ---------------------------------------------------------------------------------------------------

ecp::Trajectory along(const std::vector<Pose>& way) {
  if (way.size() < 2) return {};
  return {std::make_shared<ecp::StraightPath>(way, kLimits), {.space = Representation::xyz_angle_axis}};
}

Memory plan_ready(const X& x) {
  Memory c = x.c;
  const ecp::Coordinates goal =
      Eigen::Map<const Eigen::VectorXd>(c.ready.data(), static_cast<Eigen::Index>(c.ready.size()));
  ecp::WeighingPlan slow = c.weighing.plan;  // the column swings a stretched arm
  slow.velocity = kSwing;
  c.path = ecp::way_to(slow, x.e, goal);
  return c;
}

Memory note_ready(const X& x) {
  Memory c = x.c;
  c.T_ready = pose_of(x.e);
  return c;
}

Memory plan_way(const X& x) {
  Memory c = x.c;
  c.path = along(way_to_touch(c.plan, c.done, pose_of(x.e), c.T_ready));
  return c;
}

Memory plan_leaving(const X& x) {
  Memory c = x.c;
  c.path = along(way_back(c.plan, c.done, pose_of(x.e), c.T_ready));
  return c;
}

Memory begin_touch(const X& x) {
  Memory c = x.c;
  c.from = pose_of(x.e).p;
  c.contact = 0;
  return c;
}

Memory feel(const X& x) {
  Memory c = x.c;
  const double settled = present(x).sign * c.plan.force;
  c.contact = ecp::in_contact(c.contact, x.e.F_a[present(x).axis], settled);
  const bool far = (pose_of(x.e).p - c.from).norm() > longest_way(c.plan, c.done.size());
  if (far && c.contact == 0) c.contact = -1;
  return c;
}

Memory begin_measuring(const X& x) {
  Memory c = x.c;
  c.sum.setZero();
  c.readings = 0;
  return c;
}

Memory measure(const X& x) {
  Memory c = x.c;
  if (ecp::age(x) < c.plan.settling) return c;
  c.sum += middle_of_tip(c.plan, pose_of(x.e));
  if (++c.readings < c.plan.readings) return c;
  c.done.push_back({c.sum / c.readings, in_base(present(x), c.T_ready.R)});
  return c;
}

// --- f_ce ---------------------------------------------------------------------------------------------------

EffectorCommand go(const X& x) { return x.c.path.macrosteps() > 0 ? ecp::follow_path(x) : ecp::rest(); }

EffectorCommand press(const X& x) {
  const auto& [axis, sign] = present(x);
  return ecp::move_arm(ecp::approach(axis, sign * x.c.plan.speed, sign * x.c.plan.force, x.c.plan.inertia));
}

// --- f_cT ---------------------------------------------------------------------------------------------------

Report tell_lost(const X& x) {
  Report r = ecp::report_of(x, 0);
  const std::size_t n = x.c.done.size();
  r.verdict = Verdict::failed;
  r.fault = Fault{.code = kNothingTouched};
  r.fault.text = fmt::format("ball {}, touch {}: no contact on {:.0f} mm", n / kTouchesPerBall + 1,
                             n % kTouchesPerBall + 1, 1e3 * longest_way(x.c.plan, n));
  return r;
}

// --- f_tau --------------------------------------------------------------------------------------------------

bool my_turn(const X& x) { return x.T.go_on[0]; }
bool touched(const X& x) { return x.c.contact > kContact || lost(x.c); }
bool measured(const X& x) { return x.c.readings >= x.c.plan.readings; }

}  // namespace

bool lost(const Memory& c) { return c.contact < 0; }

// clang-format off
const std::array<Motion<Arm>, kGiveUp> kBehaviours = [] {
  const auto weighing = ecp::WeighingRows<Arm>::rows(1);
  const std::array<Motion<Arm>, 7> touching{{
    // m         name                 entry            memory            command        sensors              coordinator
    //    terminal condition
    {  kGetReady, "to the balls",      plan_ready,      ecp::retain<Arm>, go,            ecp::no_sensor<Arm>, ecp::tell<Arm>, ecp::path_ends<X>, "the arm is before the balls"},
    {  kWait,     "wait for the balls", note_ready,     note_ready,     ecp::at_rest<Arm>, ecp::no_sensor<Arm>, ecp::tell<Arm>, my_turn, "the other arm has left the balls"},
    {  kGo,       "to a ball",         plan_way,        ecp::retain<Arm>, go,            ecp::no_sensor<Arm>, ecp::tell<Arm>, ecp::path_ends<X>, "the tip is near the ball"},
    {  kFeel,     "feel the ball",     begin_touch,     feel,             press,         ecp::no_sensor<Arm>, ecp::tell<Arm>, touched, "the tip touches the ball"},
    {  kMeasure,  "measure",           begin_measuring, measure,          press,         ecp::no_sensor<Arm>, ecp::tell<Arm>, measured, "all readings taken"},
    {  kLeave,    "away from the balls", plan_leaving,  ecp::retain<Arm>, go,            ecp::no_sensor<Arm>, ecp::tell<Arm>, ecp::path_ends<X>, "the arm has drawn back"},
    {  kGiveUp,   "tell that nothing is there", ecp::retain<Arm>, ecp::retain<Arm>, ecp::at_rest<Arm>, ecp::no_sensor<Arm>, tell_lost, ecp::after<Arm, kTelling>, "the coordinator knows"},
  }};
  std::array<Motion<Arm>, kGiveUp> all{};
  std::ranges::copy(weighing, all.begin());
  std::ranges::copy(touching, all.begin() + kGetReady - 1);
  return all;
}();
// clang-format on

void take_turns(std::span<const Report> agents, std::span<Order> orders) {
  bool others_done = true;
  for (std::size_t arm = 0; arm < agents.size(); ++arm) {
    orders[arm].go_on[0] = others_done;
    others_done = others_done && agents[arm].event == kWorkDone;
  }
}

}  // namespace mrroc::calibrate_cell
