#include "tasks/rex_drive/rex_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/counted.hpp"
#include "base/latency.hpp"
#include "tasks/rex_drive/keys.hpp"
#include "tasks/rex_drive/locomotion.hpp"

namespace mrroc::rex_drive {

RexRun::RexRun(mp::TaskRun& run, RexRunParameters parameters)
    : run_(run),
      k_(std::move(parameters)),
      operator_(run.process(), run.command_server(), k_.gives_start),
      plan_(run.process(), plan_channel()),
      links_(run.process(), {kPlatform, kMap}, operator_, TaskClock::ramped(), {.outgoing = {&plan_}}) {
  if (k_.records) record_.emplace(run.process(), kPlatform);
}

double RexRun::seconds(std::int64_t macrosteps) const {
  return static_cast<double>(macrosteps) * k_.n_s * k_.dt;
}

Outcome RexRun::execute() {
  mp::CoordinatorPort<Ontology, std::function<void(const Motion<Ontology>&, const X&)>> links(
      links_, [this](const Motion<Ontology>& motion, const X& x) { observe(motion, x); });
  LinkedPort port(
      links, [this](const Ontology::Y& y) { plan_.set(y.T[kLocomotionAgent].plan); }, [](X&) {});
  X x;
  x.c.k = k_.ontology;
  Outcome o = links_.begin({});
  if (o != Outcome::terminated) return o;
  port.read(x);
  o = execute_plans(k_.plans, x, port);
  if (o == Outcome::terminated && in_vain(x)) {
    fault_ = {.code = FaultCode::position_lost,
              .value = seconds(x.i - x.c.lost_in),
              .limit = seconds(x.c.k.timeout),
              .text = "s of waiting for the position, task.position_timeout"};
    o = Outcome::faulted;
  }
  if (o == Outcome::terminated) {
    ended_in_ = x.i - latency::kMotionToReport;
    links_.send(std::vector<Order>(kAgents, Order{.finished = true}));
    run_.board().set_progress(1, "done");
  }
  if (record_) record_->collect(x.c.plan.number);
  return o;
}

void RexRun::observe(const Motion<Ontology>& motion, const X& x) {
  if (record_) record_->collect(x.c.plan.number);
  announce(motion, x);
  watch_map(x);
  report_position(x);
  watch_odometry(x);
  note_ack(x);
  show(motion, x);
  run_.each_macrostep(x.i, seconds(x.i));
}

void RexRun::announce(const Motion<Ontology>& motion, const X& x) {
  const std::string now = motion.m == kSendPlan.m || motion.m == kAwaitAck.m
                              ? fmt::format("plan {} of {}", x.c.plan.number, k_.plans.size())
                              : std::string(motion.name);
  if (now != announced_) run_.announce()(seconds(x.i), now);
  announced_ = now;
}

void RexRun::watch_map(const X& x) {
  const Report& r = x.T.agent[kLocomotionAgent];
  if (!r.ready) return;  // before its SYNCHRO has ended it does not tell
  const bool lost = (r.sensor & kMapSeen) == 0;
  if (lost && map_lost_in_ == 0) {
    map_lost_in_ = x.i;
    run_.announce()(seconds(x.i), fmt::format("map lost: the platform goes on by its wheels{}",
                                              k_.eyes ? ", the IMU and its eyes" : " and the IMU"));
  } else if (!lost && map_lost_in_ > 0) {
    run_.announce()(seconds(x.i), fmt::format("map seen again after {:.1f} s", seconds(x.i - map_lost_in_)));
    map_lost_in_ = 0;
  }
}

Fault RexRun::uncertain() const {
  Fault fault{.code = FaultCode::position_lost};
  fault.process = fmt::format("ecp-{}", kMap);
  if (!record_ || record_->messages().replies.empty()) return fault;
  const platform_reply_t& reply = record_->messages().replies.back();
  if (!is_proper(reply)) return fault;
  fault.value = uncertainty(from_message(reply).estimate);
  fault.limit = k_.lost;
  fault.text = "m, standard deviation of the position, task.position_lost";
  return fault;
}

void RexRun::report_position(const X& x) {
  const bool lost = (x.T.agent[kLocomotionAgent].sensor & kPositionLost) != 0;
  if (lost && position_lost_in_ == 0) {
    position_lost_in_ = x.i;
    const std::string waits =
        "the platform waits for it" +
        (x.c.k.timeout > 0 ? fmt::format(", {:g} s at most", seconds(x.c.k.timeout)) : std::string());
    run_.report_recoverable_fault(uncertain(), waits);
    run_.announce()(seconds(x.i), "position lost: " + waits);
  } else if (!lost && position_lost_in_ > 0) {
    run_.announce()(seconds(x.i), fmt::format("position known again after {:.1f} s: the platform goes on",
                                              seconds(x.i - position_lost_in_)));
    position_lost_in_ = 0;
  }
}

void RexRun::watch_odometry(const X& x) {
  constexpr std::int64_t kLong = 100;
  const Report& r = x.T.agent[kLocomotionAgent];
  const bool sees = (r.sensor & kOdometrySeen) != 0;
  if (sees || !r.ready) odometry_seen_in_ = x.i;  // before its SYNCHRO has ended it does not tell
  if (!k_.eyes || sees != odometry_lost_) return;
  if (sees) {
    odometry_lost_ = false;
    run_.announce()(seconds(x.i), "odometry sees again");
  } else if (const char* const why = why_no_odometry(r);
             x.i - odometry_seen_in_ >= kLong && std::string_view(why) != to_words(OdometryFinding::motion)) {
    odometry_lost_ = true;
    run_.announce()(seconds(x.i), fmt::format("odometry sees nothing for {:.0f} s: {}", seconds(kLong), why));
  }
}

const char* RexRun::why_no_odometry(const Report& r) const {
  if ((r.sensor & kPicturesStand) != 0)
    return "the wheels turn, and its pictures stand still: a camera hangs, or the platform is held back";
  const odometry_reading_t* const newest = record_ ? record_->newest_odometry() : nullptr;
  return newest && is_proper(*newest) ? to_words(support_of(*newest).finding) : "its readings do not come";
}

void RexRun::note_ack(const X& x) {
  const std::int64_t event = x.T.agent[kLocomotionAgent].event;
  if (event <= acked_) return;
  acked_ = event;
  acked_in_ = x.i - latency::kMessage;
}

double RexRun::progress(const X& x) const {
  if (k_.plans.empty() || x.c.plan.n == 0) return 0;
  const double of_plan = static_cast<double>(point_of(x.T.agent[kLocomotionAgent])) / x.c.plan.n;
  const double plans = static_cast<double>(x.c.plan.number - 1) + std::min(1.0, of_plan);
  return std::clamp(plans / static_cast<double>(k_.plans.size()), 0.0, 1.0);
}

std::string RexRun::progress_text(const X& x) const {
  const Report& r = x.T.agent[kLocomotionAgent];
  if ((r.sensor & kPositionLost) != 0)
    return fmt::format("waits for its position, lost for {:.1f} s",
                       seconds(position_lost_in_ > 0 ? x.i - position_lost_in_ : 0));
  const int point = point_of(r);
  std::string text = announced_;
  if (point > 0) text += fmt::format(", point {} of {}", point, x.c.plan.n);
  if (map_lost_in_ > 0) text += fmt::format(", map lost for {:.1f} s", seconds(x.i - map_lost_in_));
  if (odometry_lost_)
    text += fmt::format(", odometry sees nothing for {:.1f} s", seconds(x.i - odometry_seen_in_));
  return text;
}

void RexRun::show(const Motion<Ontology>& motion, const X& x) {
  run_.set_state(motion.m == kStart.m      ? TaskState::waiting_for_start
                 : links_.clock().paused() ? TaskState::paused
                                           : TaskState::running,
                 false);
  auto& board = run_.board();
  board.set_behaviour(motion.m, motion.name, motion.until);
  board.set_progress(progress(x), progress_text(x));
  show_platform(x);
}

void RexRun::show_platform(const X& x) {
  auto& board = run_.board();
  board.set_arm(kLocomotionAgent, x.T.agent[kLocomotionAgent], sensor_words(sensor_status(x)));
  if (!record_ || record_->messages().replies.empty()) return;
  const platform_reply_t& reply = record_->messages().replies.back();
  const bool known = is_proper(reply) && reply.position_known != 0;
  board.set_velocity(kLocomotionAgent, known ? from_message(reply).estimate.v : PlanarVelocity{});
}

SensorStatus RexRun::sensor_status(const X& x) const {
  const int seen = x.T.agent[kLocomotionAgent].sensor;
  SensorStatus status{.map_seen = (seen & kMapSeen) != 0,
                      .map_age = {},
                      .eyes = k_.eyes.has_value(),
                      .odometry_seen = (seen & kOdometrySeen) != 0,
                      .odometry_inliers = {}};
  if (!record_) return status;
  const odometry_reading_t* const newest = record_->newest_odometry();
  if (newest && newest->motion.valid != 0) status.odometry_inliers = newest->support.inliers;
  if (record_->messages().poses.empty()) return status;
  const std::int64_t measured = record_->messages().poses.back().pose.step;
  if (measured > 0) status.map_age = seconds(x.i) - static_cast<double>(measured) * k_.dt;
  return status;
}

DriveMessages RexRun::messages(const std::filesystem::path& folder) const {
  DriveMessages all = record_->messages();
  if (ended_in_ > 0) {
    all.cut_after(ended_in_, k_.eyes ? k_.eyes->latency : 0);
    return all;
  }
  try {
    all.add_rest(link::LogReader(folder), kPlatform);
  } catch (const FaultError&) {  // bad_log, which the run tells: there is what MP has heard
  }
  return all;
}

DriveResults RexRun::results(const std::filesystem::path& folder) const {
  DriveResults r;
  if (record_) {
    const DriveMessages heard = messages(folder);
    r.table = join(heard, k_.dt, k_.n_s);
    r.odometry = join_odometry(heard, r.table, k_.dt, k_.n_s);
    r.map_returns = map_returns(heard, k_.dt, k_.n_s);
    r.fragments = record_->fragments();
    r.rejected = heard.poses.empty() ? 0 : heard.poses.back().rejected;
  }
  r.plans = k_.plans;
  r.acked_in = acked_ == static_cast<std::int64_t>(k_.plans.size()) ? acked_in_ : 0;
  r.iterations = k_.iterations;
  return r;
}

}  // namespace mrroc::rex_drive
