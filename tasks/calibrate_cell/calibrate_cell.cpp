#include "tasks/calibrate_cell/calibrate_cell.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "base/camera_config.hpp"
#include "ecp/generators/force.hpp"
#include "ecp/generators/straight_path.hpp"
#include "tasks/calibrate_cell/vocabulary.hpp"

namespace mrroc::calibrate_cell {
namespace {

using X = Arm::X;

constexpr ecp::PathLimits kLimits{.velocity = 0.1, .acceleration = 0.4};
constexpr double kSwing = 0.2;  // of the largest speed of the joints, on the way to the balls
constexpr int kContact = 10;    // macrosteps in succession that are more than a bounce
constexpr int kSettling = 25;   // macrosteps in which the servos come to rest
constexpr int kPicture = 10;    // macrosteps: of the cameras' period, so that one picture is taken
constexpr int kTold = 5;        // macrosteps until the cameras have heard that no more pictures are wanted
constexpr int kTelling = 100;   // macrosteps in which the coordinator hears of a ball that is not there

const Direction& present(const X& x) { return direction(x.c.done.size()); }

// --- f_cc ---------------------------------------------------------------------------------------------------

ecp::Trajectory along(const std::vector<Pose>& way) {
  if (way.size() < 2) return {};
  return {std::make_shared<ecp::StraightPath>(way, kLimits), {.space = Representation::xyz_angle_axis}};
}

Memory with_way_to(const X& x, const std::vector<double>& joints) {
  Memory c = x.c;
  const ecp::Coordinates goal =
      Eigen::Map<const Eigen::VectorXd>(joints.data(), static_cast<Eigen::Index>(joints.size()));
  ecp::WeighingPlan slow = c.weighing.plan;  // the column swings a stretched arm
  slow.velocity = kSwing;
  c.path = ecp::way_to(slow, x.e, goal);
  return c;
}

/// @return the pose that is next in the present turn, null: there is none
const std::vector<double>* next_view(const Memory& c) {
  if (c.turn == 0 || c.turn > c.views.size()) return nullptr;
  const auto& joints = c.views[c.turn - 1].joints;
  return c.view < joints.size() ? &joints[c.view] : nullptr;
}

Memory plan_stand(const X& x) {
  return x.c.turn < x.c.views.size() ? with_way_to(x, x.c.views[x.c.turn].from) : x.c;
}
Memory plan_view(const X& x) {
  const std::vector<double>* const joints = next_view(x.c);
  return joints ? with_way_to(x, *joints) : x.c;
}
Memory plan_ready(const X& x) { return with_way_to(x, x.c.ready); }

Memory wait_to_view(const X& x) {
  Memory c = x.c;
  if (c.turn == c.views.size()) return c;
  c.waits_for = static_cast<int>(c.views[c.turn].turn);
  ++c.turn;
  c.view = 0;
  return c;
}

Memory count_view(const X& x) {
  Memory c = x.c;
  ++c.view;
  return c;
}

Memory note_ready(const X& x) {
  Memory c = x.c;
  c.waits_for = c.touch_turn;
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

/// At the end of the way, by the servos: at rest they are off, and with little friction a stretched arm sags.
EffectorCommand hold(const X& x) {
  const auto& path = x.c.path;
  return path.macrosteps() > 0 ? ecp::move_arm(path.command(path.macrosteps())) : ecp::rest();
}

EffectorCommand press(const X& x) {
  const auto& [axis, sign] = present(x);
  return ecp::move_arm(ecp::approach(axis, sign * x.c.plan.speed, sign * x.c.plan.force, x.c.plan.inertia));
}

// --- f_cT ---------------------------------------------------------------------------------------------------

Report tell_turn(const X& x) {
  Report r = ecp::report_of(x, 0);
  r.event = x.c.waits_for;
  return r;
}

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

bool my_turn(const X& x) { return x.T.variant == x.c.waits_for; }
bool touched(const X& x) { return x.c.contact > kContact || lost(x.c); }
bool measured(const X& x) { return x.c.readings >= x.c.plan.readings; }

}  // namespace

bool lost(const Memory& c) { return c.contact < 0; }

// clang-format off
const std::array<Motion<Arm>, kGiveUp> kBehaviours = [] {
  const auto weighing = ecp::WeighingRows<Arm>::rows(1);
  const std::array<Motion<Arm>, 13> own{{
    // m         name                 entry            memory            command        sensors              coordinator
    //    terminal condition
    {  kStand,    "where it stands for the pictures", plan_stand, ecp::retain<Arm>, go,  ecp::no_sensor<Arm>, tell_turn, ecp::path_ends<X>, "the arm is there"},
    {  kWaitToView, "wait for the pictures", wait_to_view, ecp::retain<Arm>, hold, ecp::no_sensor<Arm>, tell_turn, my_turn, "it is the arm's turn"},
    {  kToView,   "to a view",         plan_view,       ecp::retain<Arm>, go,            ecp::no_sensor<Arm>, tell_turn, ecp::path_ends<X>, "the arm is there"},
    {  kSettle,   "come to rest",      ecp::retain<Arm>, ecp::retain<Arm>, hold, ecp::no_sensor<Arm>, tell_turn, ecp::after<Arm, kSettling>, "the arm rests"},
    {  kLook,     "hold still for a picture", ecp::retain<Arm>, ecp::retain<Arm>, hold, ecp::no_sensor<Arm>, tell_turn, ecp::after<Arm, kPicture>, "a picture is taken"},
    {  kKeepStill, "hold still till the cameras know", count_view, ecp::retain<Arm>, hold, ecp::no_sensor<Arm>, tell_turn, ecp::after<Arm, kTold>, "no picture is taken any more"},
    {  kGetReady, "to the balls",      plan_ready,      ecp::retain<Arm>, go,            ecp::no_sensor<Arm>, tell_turn, ecp::path_ends<X>, "the arm is before the balls"},
    {  kWait,     "wait for the balls", note_ready,     note_ready,     ecp::at_rest<Arm>, ecp::no_sensor<Arm>, tell_turn, my_turn, "the other arm has left the balls"},
    {  kGo,       "to a ball",         plan_way,        ecp::retain<Arm>, go,            ecp::no_sensor<Arm>, tell_turn, ecp::path_ends<X>, "the tip is near the ball"},
    {  kFeel,     "feel the ball",     begin_touch,     feel,             press,         ecp::no_sensor<Arm>, tell_turn, touched, "the tip touches the ball"},
    {  kMeasure,  "measure",           begin_measuring, measure,          press,         ecp::no_sensor<Arm>, tell_turn, measured, "all readings taken"},
    {  kLeave,    "away from the balls", plan_leaving,  ecp::retain<Arm>, go,            ecp::no_sensor<Arm>, tell_turn, ecp::path_ends<X>, "the arm has drawn back"},
    {  kGiveUp,   "tell that nothing is there", ecp::retain<Arm>, ecp::retain<Arm>, ecp::at_rest<Arm>, ecp::no_sensor<Arm>, tell_lost, ecp::after<Arm, kTelling>, "the coordinator knows"},
  }};
  std::array<Motion<Arm>, kGiveUp> all{};
  std::ranges::copy(weighing, all.begin());
  std::ranges::copy(own, all.begin() + kStand - 1);
  return all;
}();
// clang-format on

void take_turns(std::span<const Report> agents, std::span<Order> orders) {
  const int next = std::ranges::min_element(agents, {}, &Report::event)->event;
  for (std::size_t arm = 0; arm < agents.size(); ++arm)
    orders[arm].variant = next > 0 && agents[arm].event == next ? next : 0;
}

SensorSetting want_pictures(std::span<const Report> agents) {
  const bool still = std::ranges::any_of(agents, [](const Report& r) { return r.m == kLook; });
  return {.mode = still ? kTakePictures : 0};
}

}  // namespace mrroc::calibrate_cell
