#include "tasks/box_push/box_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/latency.hpp"
#include "ecp/map/map_agent.hpp"
#include "tasks/box_push/keys.hpp"
#include "tasks/box_push/vocabulary.hpp"

namespace mrroc::box_push {
namespace {

std::array<std::unique_ptr<link::OutgoingLink<FragmentOrder>>, kPlatforms> go_links(link::Process& process) {
  std::array<std::unique_ptr<link::OutgoingLink<FragmentOrder>>, kPlatforms> go;
  for (std::size_t k = 0; k < kPlatforms; ++k)
    go[k] = std::make_unique<link::OutgoingLink<FragmentOrder>>(process, go_channel(kKeys[k]));
  return go;
}

double seconds(std::int64_t macrosteps) { return static_cast<double>(macrosteps) * kPlatformPeriod; }

Fault why_not(FaultCode code, double value, double limit, const char* what) {
  return {.code = code, .value = value, .limit = limit, .text = what};
}

/// @return why the box is not at its goal
Fault reason(const Coordinator::X& x) {
  const CoordinatorMemory& c = x.c;
  if (position_gone(x))
    return why_not(FaultCode::position_lost, seconds(x.i - c.lost_in), seconds(c.k.timeout),
                   "s of waiting for the position, task.position_timeout");
  if (c.dead_end == DeadEnd::for_box) return {.code = kNoWayForBox};
  if (c.dead_end == DeadEnd::for_platform) return {.code = kNoWayBehindBox};
  if (stays_behind(c.run)) return why_not(kBoxNotMoved, c.run.lag, kMostLag, "m that it has stayed behind");
  const PlanarPose e = error_of(c);
  const double far = std::hypot(e.x, e.y);
  if (far > c.k.tolerance.position)
    return why_not(kBoxNotThereYet, far, c.k.tolerance.position, "m from its goal");
  return why_not(kBoxNotThereYet, std::abs(e.phi), c.k.tolerance.heading, "rad turned from its goal");
}

}  // namespace

BoxRun::BoxRun(mp::TaskRun& run, BoxRunParameters parameters)
    : run_(run),
      k_(std::move(parameters)),
      operator_(run.process(), run.command_server(), k_.gives_start),
      seen_(run.process(), std::string(kBox) + ".motion_capture", {k_.capture.period, k_.capture.latency}),
      go_(go_links(run.process())),
      links_(
          run.process(), {kKeys[0], kKeys[1], kMaps[0], kMaps[1]}, operator_, TaskClock::ramped(),
          {.sources = {seen_.source()},
           .here = [this](std::int64_t i, std::int64_t) { return seen_.here((i - 1) * k_.coordinator.n_s); },
           .outgoing = {go_[0].get(), go_[1].get()}}) {
  if (!k_.records) return;
  record_.emplace(run.process());
  for (std::size_t k = 0; k < kPlatforms; ++k)
    replies_[k] = run.process().inbox<platform_reply_t>(std::string(kKeys[k]) + ".reply");
}

Outcome BoxRun::execute() {
  mp::CoordinatorPort<Coordinator, std::function<void(const Motion<Coordinator>&, const X&)>> links(
      links_, [this](const Motion<Coordinator>& motion, const X& x) { observe(motion, x); });
  LinkedPort port(
      links,
      [this](const Coordinator::Y& y) {
        for (std::size_t k = 0; k < kPlatforms; ++k) go_[k]->set(y.T[k].go);
      },
      [this](X& x) { x.V.box = seen_.at((x.i - 1) * k_.coordinator.n_s).value_or(BoxSeen{}.box); });
  X x;
  x.c.k = k_.coordinator;
  Outcome o = links_.begin({});
  if (o != Outcome::terminated) return o;
  port.read(x);
  o = push_box(x, port);
  if (o == Outcome::terminated) note_end(x, o);
  if (o == Outcome::terminated) {
    links_.send(std::vector<Order>(kAgents, Order{.finished = true}));
    run_.board().set_progress(1, "done");
  }
  return o;
}

void BoxRun::note_end(const X& x, Outcome& o) {
  at_goal_ = at_goal(x.c);
  if (at_goal_) return;
  o = Outcome::faulted;
  fault_ = reason(x);
}

void BoxRun::observe(const Motion<Coordinator>& motion, const X& x) {
  if (record_) record_->collect({x.i, motion.m, x.c.pushes});
  last_in_ = x.i - latency::kMotionToReport;
  announce(motion, x);
  const bool lost = x.c.lost_in > 0;
  if (lost && !lost_)
    run_.report_recoverable_fault(Fault{.code = FaultCode::position_lost},
                                  "both platforms stand, and go on when it is seen again");
  lost_ = lost;
  show(motion, x);
  run_.each_macrostep(x.i, seconds(x.i));
}

std::string BoxRun::push_words(const Motion<Coordinator>& motion, const X& x) {
  const int now = x.c.pushes + (motion.m == kApproach.m ? 1 : 0);
  if (now == 0) return "no push yet";
  const int of = x.c.pushes + x.c.outlook.pushes - (motion.m == kApproach.m ? 0 : 1);
  return fmt::format("push {} of {}", now, std::max(now, of));
}

void BoxRun::announce(const Motion<Coordinator>& motion, const X& x) {
  std::string now(motion.name);
  if (motion.m == kApproach.m && x.c.dead_end == DeadEnd::none)
    now += fmt::format(", push {} of {}, about {:.0f} s to the end", x.c.pushes + 1,
                       x.c.pushes + x.c.outlook.pushes, x.c.outlook.seconds);
  if (motion.m != announced_) run_.announce()(seconds(x.i), now);
  announced_ = motion.m;
}

double BoxRun::progress(const X& x) {
  if (!x.V.box.seen) return 0;
  constexpr double kTurn = 0.5;  // way that a turn is worth [m/rad]
  const PlanarPose e = seen_from(x.c.k.goal, x.V.box.p);
  const double left = std::hypot(e.x, e.y) + kTurn * std::abs(e.phi);
  whole_ = std::max(whole_, left);
  return whole_ > 0 ? 1 - left / whole_ : 1;
}

void BoxRun::show(const Motion<Coordinator>& motion, const X& x) {
  run_.set_state(motion.m == kStart.m      ? TaskState::waiting_for_start
                 : links_.clock().paused() ? TaskState::paused
                                           : TaskState::running,
                 false);
  auto& board = run_.board();
  board.set_behaviour(motion.m, motion.name, motion.until);
  const PlanarPose e = seen_from(x.c.k.goal, x.V.box.p);
  const std::string left = x.V.box.seen
                               ? fmt::format("box {:.0f} mm, {:.1f} degrees from its goal",
                                             1e3 * std::hypot(e.x, e.y), e.phi * 180 / std::numbers::pi)
                               : "box not seen";
  board.set_progress(progress(x), fmt::format("{}: {}", push_words(motion, x), left));
  for (std::size_t k = 0; k < kPlatforms; ++k) {
    board.set_arm(k, x.T.agent[k],
                  x.T.agent[kPlatforms + k].sensor == ecp::kMapSeen ? "map seen" : "map lost");
    show_velocity(k);
  }
}

void BoxRun::show_velocity(std::size_t k) {
  const platform_reply_t* const newest = replies_[k] ? replies_[k]->newest() : nullptr;
  if (!newest) return;
  const bool known = is_proper(*newest) && newest->position_known != 0;
  run_.board().set_velocity(k, known ? from_message(*newest).estimate.v : PlanarVelocity{});
}

PushResults BoxRun::results() const {
  PushResults r;
  if (record_) r.table = record_->table(last_in_);
  r.k = k_.coordinator;
  return r;
}

}  // namespace mrroc::box_push
