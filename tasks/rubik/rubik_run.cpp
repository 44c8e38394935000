#include "tasks/rubik/rubik_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <future>

#include "base/counted.hpp"
#include "base/cube/facelets.hpp"
#include "tasks/rubik/config.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/results.hpp"
#include "tasks/rubik/vocabulary.hpp"

namespace mrroc::rubik {
namespace {

/// Wall time that a macrostep of thinking may take: some of the others wait for ten of them.
constexpr std::chrono::milliseconds kThinkingTimeout{800};

constexpr int kRounds = 2;  // of solving, when the cube is found not to be solved in the end

}  // namespace

FaultCode code_of(FailureReason failure) {
  switch (failure) {
    case FailureReason::no_contact:
      return FaultCode::no_contact;
    case FailureReason::elsewhere:
      return kCubeSlipped;
    case FailureReason::missed:
    case FailureReason::not_released:
      return kGraspMissed;
    case FailureReason::jammed:
      return kFaceJammed;
    case FailureReason::dropped:
      return kCubeDropped;
    case FailureReason::none:
      break;
  }
  return FaultCode::internal_error;
}

RubikRun::RubikRun(mp::TaskRun& run, const Parameters& parameters, PlannerServices services, bool gives_start)
    : run_(run),
      k_(parameters),
      services_(std::move(services)),
      operator_(run.process(), run.command_server(), gives_start),
      camera_input_(run.process(), services_.camera),
      arms_{ArmLinks{{run.process(), kArmKeys[0] + std::string(".cube_order")},
                     {run.process(), kArmKeys[0] + std::string(".cube_report")}},
            ArmLinks{{run.process(), kArmKeys[1] + std::string(".cube_order")},
                     {run.process(), kArmKeys[1] + std::string(".cube_report")}}},
      links_(run.process(), {kArmKeys[0], kArmKeys[1]}, operator_, TaskClock::at_safe_row(kResume.m),
             others()),
      truth_(run.process()),
      recorder_(kArms, mp::TraceNumbers::coordinator, kPacing.dt, kPacing.n_s) {}

link::OtherLinks RubikRun::others() {
  link::OtherLinks others = camera_input_.others();
  for (ArmLinks& arm : arms_) {
    others.outgoing.push_back(&arm.order);
    others.incoming.push_back(&arm.report);
  }
  return others;
}

void RubikRun::give(const Coordinator::Y& y) {
  camera_input_.ask(y.V);
  for (std::size_t arm = 0; arm < kArms; ++arm) arms_[arm].order.set(y.T[arm].cube);
}

void RubikRun::take(X& x) {
  for (std::size_t arm = 0; arm < kArms; ++arm) x.T.agent[arm].cube = arms_[arm].report.image().value;
  camera_input_.read(x.i, x.V);
}

double RubikRun::seconds(std::int64_t macrosteps) const {
  return static_cast<double>(macrosteps) * kPacing.macrostep_s();
}

Outcome RubikRun::execute() {
  Links links(links_, [this](const auto& motion, const X& x) { observe(motion, x); });
  Port port(
      links, [this](const Coordinator::Y& y) { give(y); }, [this](X& read) { take(read); });
  X x;
  x.c.k = k_;
  Outcome o = links_.begin({.m = kWait});
  if (o == Outcome::terminated) {
    try {
      port.read(x);
      o = work(x, port);
    } catch (const FaultError& e) {
      fault_ = e.fault();
      o = Outcome::faulted;
    }
  }
  if (o == Outcome::terminated) {
    announce_end();
    links_.send(std::vector<Order>(kArms, Order{.m = kWait, .finished = true}));
    run_.board().set_progress(1, "done");
  }
  if (o == Outcome::faulted && !fault_) fault_ = links_.fault();
  truth_.collect();
  return o;
}

template <class T>
Outcome RubikRun::think(X& x, Port& port, std::function<T()> work, std::optional<T>& result) {
  auto thought = std::async(services_.aside ? std::launch::async : std::launch::deferred, std::move(work));
  if (services_.aside)
    thought_ = [&thought] { return thought.wait_for(std::chrono::seconds(0)) == std::future_status::ready; };
  const Outcome o = move(kThink, x, port);
  if (o == Outcome::terminated && thought_) run_.process().await(thought_);
  thought_ = {};
  if (o == Outcome::terminated) result = thought.get();
  return o;
}

Outcome RubikRun::work(X& x, Port& port) {
  doing_ = "wait for start";
  Outcome o = move(kWaitForStart, x, port);
  PlanStart now = services_.start;
  std::optional<Cube> cube = services_.known;
  for (int round = 0; o == Outcome::terminated; ++round) {
    if (services_.camera) o = read_cube(x, port, now, cube);
    if (o != Outcome::terminated) break;
    if (round > 0) record_.verified = cube == Cube{};
    if (record_.verified.value_or(false)) break;
    if (round == kRounds) return fail(kCubeMisread, "the cube is not solved by what should solve it");
    o = solve(x, port, now, *cube);
    if (!services_.camera) break;
  }
  return o;
}

Outcome RubikRun::read_cube(X& x, Port& port, PlanStart& now, std::optional<Cube>& cube) {
  Program<Port> program(x, port, record_.execution_log);
  views_.clear();
  for (int attempt = 0; attempt < kReadings; ++attempt) {
    doing_ = "thinking of how to look";
    std::optional<Planned> planned;
    Outcome o = think<Planned>(
        x, port, [&] { return services_.plan_reading(now, attempt); }, planned);
    if (o != Outcome::terminated) return o;
    if (!planned->plan) return plan_failed(*planned);
    unseen_.clear();
    x.c.shown.place = attempt;
    Moves none;
    o = execute_plan(*planned->plan, x, program, now, none);
    if (o != Outcome::terminated) return o;
    record_.readings.push_back(read_state(views_));
    const StateReading& reading = record_.readings.back();
    announce(fmt::format("read {}, confidence {:.2f} at least{}{}", reading.facelets,
                         std::ranges::min(reading.confidence), reading.text.empty() ? "" : ": ",
                         reading.text));
    cube = reading.cube;
    if (cube) return o;
    if (attempt + 1 < kReadings) announce_unseen();
  }
  return fail(kCubeMisread, record_.readings.back().text);
}

Outcome RubikRun::solve(X& x, Port& port, PlanStart& now, const Cube& cube) {
  struct Thought {
    Solution solution;
    Planned planned;
  };
  doing_ = "thinking of a solution";
  std::optional<Thought> thought;
  const auto find = [&] {
    Thought t{services_.solve(cube), {}};
    t.planned = services_.plan(now, t.solution.moves, blocked_);
    return t;
  };
  Outcome o = think<Thought>(x, port, find, thought);
  if (o != Outcome::terminated) return o;
  if (!thought->planned.plan) return plan_failed(thought->planned);
  const Plan& plan = *thought->planned.plan;
  record_.solution = plan.turns;
  record_.planned_s = plan.seconds;
  if (plan.turns.empty()) {
    announce("solution: nothing to turn, the cube is solved");
  } else {
    announce(fmt::format("solution: {}: {}; {}, about {:.0f} s", counted(plan.turns.size(), "turn"),
                         to_string(plan.turns), counted(plan.regrasps, "re-grasp"), plan.seconds));
    announce("found by " + describe(thought->solution));
  }
  const std::int64_t begun = x.i;
  o = turn_all(plan, x, port, now);
  record_.turning += x.i - begun;
  return o;
}

Outcome RubikRun::turn_all(const Plan& plan, X& x, Port& port, PlanStart& now) {
  Program<Port> program(x, port, record_.execution_log);
  Moves left;
  Outcome o = execute_plan(plan, x, program, now, left);
  while (o == Outcome::terminated && !left.empty()) {
    doing_ = "thinking of the other way round";
    std::optional<Planned> rest;
    o = think<Planned>(
        x, port, [&] { return services_.plan(now, left, blocked_); }, rest);
    if (o != Outcome::terminated) return o;
    if (!rest->plan)
      return fail(kFaceJammed, fmt::format("{} does not turn, and not the other way round: {}",
                                           to_string(left.front()), rest->text));
    o = execute_plan(*rest->plan, x, program, now, left);
  }
  return o;
}

Outcome RubikRun::plan_failed(const Planned& planned) {
  return fail(kNoPlan, fmt::format("{}: {}", to_string(planned.why), planned.text));
}

Outcome RubikRun::execute_plan(const Plan& plan, X& x, Program<Port>& program, PlanStart& now, Moves& left) {
  left.clear();
  const std::size_t all = std::max(record_.solution.size(), plan.turns.size());
  std::size_t turn = plan.turns.empty() ? 0 : all - plan.turns.size();
  for (const Step& step : plan.steps) {
    if (step.turn) ++turn;
    progress_ = plan.turns.empty() ? 0 : static_cast<double>(turn) / static_cast<double>(all + 1);
    doing_ = step.turn    ? fmt::format("move {} of {}: {}", turn, all, to_string(*step.turn))
             : step.shows ? fmt::format("show {}", letter(*step.shows))
                          : "re-grasp";
    announce(doing_);
    Outcome o = program.execute(step);
    const bool otherwise = o == Outcome::faulted && may_turn_otherwise(step, program);
    if (otherwise) {
      announce(fmt::format("{} jams {}: it will be turned the other way round", letter(step.turn->face()),
                           step.angle > 0 ? "clockwise" : "counterclockwise"));
      blocked_.add(step.turn->face(), step.angle);
      now = {step.before_grasp, step.withdrawn};
      left.assign(plan.turns.end() - static_cast<std::ptrdiff_t>(all + 1 - turn), plan.turns.end());
      o = program.withdraw(step);
    }
    o = judge(o, program);
    if (record_.execution_log.back().done) announce_turn(record_.execution_log.back());
    if (o != Outcome::terminated || otherwise) return o;
    if (!step.shows) continue;
    views_.push_back(view_of(step.R_GC, x.V.reading));
    if (!x.V.reading.valid) unseen_ += (unseen_.empty() ? "" : ", ") + std::string{letter(*step.shows)};
  }
  now = {plan.end, plan.end_joints};
  progress_ = 1;
  return Outcome::terminated;
}

bool RubikRun::may_turn_otherwise(const Step& step, const Program<Port>& program) const {
  return program.may_withdraw(step) && !blocked_.has(step.turn->face(), -step.angle);
}

Outcome RubikRun::judge(Outcome o, const Program<Port>& program) {
  const CycleRecord& entry = record_.execution_log.back();
  if (entry.grips > 1) announce(fmt::format("gripped at attempt {}", entry.grips));
  if (entry.attempts > 1 && o == Outcome::terminated && !entry.given_up)
    announce(fmt::format("turned at attempt {}", entry.attempts));
  if (o == Outcome::faulted && program.failure() != FailureReason::none)
    return fail(code_of(program.failure()), fmt::format("{}: {}", doing_, to_string(program.failure())));
  return o;
}

void RubikRun::announce_turn(const CycleRecord& entry) {
  const TurnRow turn = turn_of(entry, 0, record_, truth_);
  announce(fmt::format("turned in {:.1f} s, at most {:.1f} N across, {:.1f} N m",
                       seconds(entry.turn_ended - entry.turn_begun), turn.force_peak_N, turn.torque_peak_Nm));
}

void RubikRun::announce_unseen() {
  announce(fmt::format(
      "that is no cube for certain{}: all faces are shown once more, turned otherwise to the light",
      unseen_.empty() ? "" : ", and of " + unseen_ + " there is no good picture"));
}

void RubikRun::announce_end() {
  if (record_.verified.value_or(false))
    announce("the cube is solved: all six faces have been seen again");
  else if (const auto& rows = truth_.rows(); !rows.empty())
    announce(rows.back().facelets == to_facelets(Cube{}) ? "the cube is solved" : "the cube is NOT solved");
  else
    announce("all turns are done; nobody has looked whether the cube is solved");
}

Outcome RubikRun::fail(FaultCode code, const std::string& text) {
  fault_ = Fault{.code = code};
  fault_.text = text;
  return Outcome::faulted;
}

void RubikRun::announce(const std::string& text) { run_.announce()(seconds(i_), text); }

void RubikRun::observe(const Motion<Coordinator>& motion, const X& x) {
  i_ = x.i;
  // However long it takes, thinking lasts the same simulated time; the others wait, and must not wait for too long.
  if (thought_) run_.process().await(thought_, link::Process::Clock::now() + kThinkingTimeout);
  truth_.collect();
  std::array<Report, kArms> reports;
  for (std::size_t arm = 0; arm < kArms; ++arm) reports[arm] = static_cast<const Report&>(x.T.agent[arm]);
  recorder_.note(x.i, motion.m, reports);
  recorder_.add_rows(record_.traces);
  show(motion, x);
  run_.each_macrostep(x.i, seconds(x.i));
}

void RubikRun::show(const Motion<Coordinator>& motion, const X& x) {
  run_.set_state(motion.m == kWaitForStart.m ? TaskState::waiting_for_start
                 : links_.clock().paused()   ? TaskState::paused
                                             : TaskState::running,
                 false);
  auto& board = run_.board();
  board.set_behaviour(motion.m, motion.name, motion.until);
  board.set_progress(progress_, doing_);
  for (std::size_t arm = 0; arm < kArms; ++arm) board.set_arm(arm, x.T.agent[arm], "");
}

}  // namespace mrroc::rubik
