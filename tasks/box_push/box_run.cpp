#include "tasks/box_push/box_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/latency.hpp"
#include "ecp/map/map_agent.hpp"
#include "tasks/box_push/keys.hpp"

namespace mrroc::box_push {
namespace {

std::array<std::unique_ptr<link::OutgoingLink<FragmentOrder>>, kPlatforms> go_links(link::Process& process) {
  std::array<std::unique_ptr<link::OutgoingLink<FragmentOrder>>, kPlatforms> go;
  for (std::size_t k = 0; k < kPlatforms; ++k)
    go[k] = std::make_unique<link::OutgoingLink<FragmentOrder>>(process, go_channel(kKeys[k]));
  return go;
}

double seconds(std::int64_t macrosteps) { return static_cast<double>(macrosteps) * kPlatformPeriod; }

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
  if (k_.records) record_.emplace(run.process());
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
  const PlanarPose e = error_of(x.c);
  if (position_gone(x))
    fault_ = {.code = FaultCode::position_lost,
              .value = seconds(x.i - x.c.lost_in),
              .limit = seconds(x.c.k.timeout),
              .text = "seconds"};
  else
    fault_ = {.code = FaultCode::path_not_found,
              .value = std::hypot(e.x, e.y),
              .limit = x.c.k.tolerance.position,
              .text = x.c.vain ? "no way for platforms or box [m]" : "the box is not at its goal [m]"};
}

void BoxRun::observe(const Motion<Coordinator>& motion, const X& x) {
  if (record_) record_->collect({x.i, motion.m, x.c.pushes});
  last_in_ = x.i - latency::kMotionToReport;
  if (motion.m != announced_) run_.announce()(seconds(x.i), std::string(motion.name));
  announced_ = motion.m;
  const bool lost = x.c.lost_in > 0;
  if (lost && !lost_)
    run_.report_recoverable_fault(Fault{.code = FaultCode::position_lost},
                                  "both platforms stand, and go on when it is seen again");
  lost_ = lost;
  show(motion, x);
  run_.each_macrostep(x.i, seconds(x.i));
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
  board.set_progress(progress(x), fmt::format("push {}: {}", x.c.pushes, left));
  for (std::size_t k = 0; k < kPlatforms; ++k)
    board.set_arm(k, x.T.agent[k],
                  x.T.agent[kPlatforms + k].sensor == ecp::kMapSeen ? "map seen" : "map lost");
}

PushResults BoxRun::results() const {
  PushResults r;
  if (record_) r.table = record_->table(last_in_);
  r.k = k_.coordinator;
  return r;
}

}  // namespace mrroc::box_push
