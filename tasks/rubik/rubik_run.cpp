#include "tasks/rubik/rubik_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <future>

#include "tasks/rubik/config.hpp"
#include "tasks/rubik/results.hpp"

namespace mrroc::rubik {
namespace {

/// From an order of the coordinator to the report about its execution (MG 11-15).
constexpr std::size_t kLoopDelay = 3;

/// Wall time that a macrostep of thinking may take: some of the others wait for ten of them.
constexpr std::chrono::milliseconds kPatienceOfOthers{800};

constexpr int kRounds = 2;  // of solving, when the cube is found not to be solved in the end

}  // namespace

FaultCode code_of(Trouble trouble) {
  switch (trouble) {
    case Trouble::no_contact:
      return FaultCode::no_contact;
    case Trouble::elsewhere:
      return FaultCode::cube_slipped;
    case Trouble::missed:
    case Trouble::not_released:
      return FaultCode::grasp_missed;
    case Trouble::jammed:
      return FaultCode::face_jammed;
    case Trouble::dropped:
      return FaultCode::cube_dropped;
    case Trouble::none:
      break;
  }
  return FaultCode::internal_error;
}

RubikRun::RubikRun(mp::TaskRun& run, const Parameters& parameters, Brain brain, bool gives_start,
                   std::function<void(const std::string&)> announce)
    : run_(run),
      k_(parameters),
      brain_(std::move(brain)),
      operator_(run.process(), run.desk(), gives_start),
      links_(run.process(), {kArmKeys[0], kArmKeys[1]}, operator_),
      eyes_(run.process(), brain_.camera),
      truth_(run.process()),
      announce_(std::move(announce)) {}

double RubikRun::seconds(std::int64_t macrosteps) const {
  return static_cast<double>(macrosteps) * kPacing.macrostep_s();
}

Outcome RubikRun::execute() {
  Links links(links_, [this](const auto& motion, const X& x) { observe(motion, x); });
  Port port(links, eyes_);
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
    links_.send(std::vector<Order>(kArms, Order{.m = kWait, .finished = true}));
    run_.board().set_progress(1, "done");
  }
  if (o == Outcome::faulted && !fault_) fault_ = links_.fault();
  return o;
}

template <class T>
Outcome RubikRun::think(X& x, Port& port, std::function<T()> work, std::optional<T>& result) {
  auto thought = std::async(brain_.aside ? std::launch::async : std::launch::deferred, std::move(work));
  if (brain_.aside)
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
  PlanStart now = brain_.start;
  std::optional<Cube> cube = brain_.known;
  for (int round = 0; o == Outcome::terminated; ++round) {
    if (brain_.camera) o = read_cube(x, port, now, cube);
    if (o != Outcome::terminated) break;
    if (round > 0) record_.verified = cube == Cube{};
    if (record_.verified.value_or(false)) break;
    if (round == kRounds)
      return fail(FaultCode::cube_misread, "the cube is not solved by what should solve it");
    o = solve(x, port, now, *cube);
    if (!brain_.camera) break;
  }
  return o;
}

Outcome RubikRun::read_cube(X& x, Port& port, PlanStart& now, std::optional<Cube>& cube) {
  Program<Port> program(x, port, record_.journal);
  views_.clear();
  for (int attempt = 0; attempt < kReadings; ++attempt) {
    doing_ = "thinking of how to look";
    std::optional<Planned> planned;
    Outcome o = think<Planned>(
        x, port, [&] { return brain_.plan_reading(now, attempt); }, planned);
    if (o != Outcome::terminated) return o;
    if (!planned->plan) return plan_failed(*planned);
    Moves none;
    o = execute_plan(*planned->plan, x, program, now, none);
    if (o != Outcome::terminated) return o;
    record_.readings.push_back(read_state(views_));
    const StateReading& reading = record_.readings.back();
    say(fmt::format("read {}, confidence {:.2f} at least{}{}", reading.facelets,
                    std::ranges::min(reading.confidence), reading.text.empty() ? "" : ": ", reading.text));
    cube = reading.cube;
    if (cube) return o;
  }
  return fail(FaultCode::cube_misread, record_.readings.back().text);
}

Outcome RubikRun::solve(X& x, Port& port, PlanStart& now, const Cube& cube) {
  struct Thought {
    Solution solution;
    Planned planned;
  };
  doing_ = "thinking of a solution";
  std::optional<Thought> thought;
  const auto find = [&] {
    Thought t{brain_.solve(cube), {}};
    t.planned = brain_.plan(now, t.solution.moves, jams_);
    return t;
  };
  Outcome o = think<Thought>(x, port, find, thought);
  if (o != Outcome::terminated) return o;
  if (!thought->planned.plan) return plan_failed(thought->planned);
  const Plan& plan = *thought->planned.plan;
  record_.solution = plan.turns;
  record_.planned_s = plan.seconds;
  if (plan.turns.empty()) {
    say("solution: nothing to turn, the cube is solved");
  } else {
    say(fmt::format("solution: {} turns: {}; {} re-grasps, about {:.0f} s", plan.turns.size(),
                    to_string(plan.turns), plan.regrasps, plan.seconds));
    say("found by " + describe(thought->solution));
  }
  const std::int64_t begun = x.i;
  o = turn_all(plan, x, port, now);
  record_.turning += x.i - begun;
  return o;
}

Outcome RubikRun::turn_all(const Plan& plan, X& x, Port& port, PlanStart& now) {
  Program<Port> program(x, port, record_.journal);
  Moves left;
  Outcome o = execute_plan(plan, x, program, now, left);
  while (o == Outcome::terminated && !left.empty()) {
    doing_ = "thinking of the other way round";
    std::optional<Planned> rest;
    o = think<Planned>(
        x, port, [&] { return brain_.plan(now, left, jams_); }, rest);
    if (o != Outcome::terminated) return o;
    if (!rest->plan)
      return fail(FaultCode::face_jammed, fmt::format("{} does not turn, and not the other way round: {}",
                                                      to_string(left.front()), rest->text));
    o = execute_plan(*rest->plan, x, program, now, left);
  }
  return o;
}

Outcome RubikRun::plan_failed(const Planned& planned) {
  return fail(FaultCode::no_plan, fmt::format("{}: {}", to_string(planned.why), planned.text));
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
    say(doing_);
    Outcome o = program.execute(step);
    const bool otherwise = o == Outcome::faulted && may_turn_otherwise(step, program);
    if (otherwise) {
      say(fmt::format("{} jams {}: it will be turned the other way round", letter(step.turn->face()),
                      step.angle > 0 ? "clockwise" : "counterclockwise"));
      jams_.add(step.turn->face(), step.angle);
      now = {step.before_grasp, step.withdrawn};
      left.assign(plan.turns.end() - static_cast<std::ptrdiff_t>(all + 1 - turn), plan.turns.end());
      o = program.withdraw(step);
    }
    o = judge(o, program);
    if (record_.journal.back().done) tell_turn(record_.journal.back());
    if (o != Outcome::terminated || otherwise) return o;
    if (step.shows) note_view(step, x.V.reading);
  }
  now = {plan.end, plan.end_joints};
  progress_ = 1;
  return Outcome::terminated;
}

bool RubikRun::may_turn_otherwise(const Step& step, const Program<Port>& program) const {
  return program.may_withdraw(step) && !jams_.has(step.turn->face(), -step.angle);
}

Outcome RubikRun::judge(Outcome o, const Program<Port>& program) {
  const CycleNote& note = record_.journal.back();
  if (note.grips > 1) say(fmt::format("gripped at attempt {}", note.grips));
  if (note.attempts > 1 && o == Outcome::terminated && !note.given_up)
    say(fmt::format("turned at attempt {}", note.attempts));
  if (o == Outcome::faulted && program.trouble() != Trouble::none)
    return fail(code_of(program.trouble()), fmt::format("{}: {}", doing_, to_string(program.trouble())));
  return o;
}

void RubikRun::tell_turn(const CycleNote& note) {
  const TurnRow turn = turn_of(note, 0, record_, truth_);
  say(fmt::format("turned in {:.1f} s, at most {:.1f} N across, {:.1f} N m",
                  seconds(note.turn_ended - note.turn_begun), turn.force_peak_N, turn.torque_peak_Nm));
}

void RubikRun::note_view(const Step& step, const CubeFaceReading& reading) {
  views_.push_back(view_of(step.R_GC, reading));
  if (!reading.valid) say(fmt::format("face {} is not seen well", letter(*step.shows)));
}

Outcome RubikRun::fail(FaultCode code, const std::string& text) {
  fault_ = Fault{.code = code};
  fault_.text = text;
  return Outcome::faulted;
}

void RubikRun::say(const std::string& text) { announce_(fmt::format("{:8.2f} s  {}", seconds(i_), text)); }

void RubikRun::observe(const Motion<Coordinator>& motion, const X& x) {
  i_ = x.i;
  // However long it takes, thinking lasts the same simulated time; the others wait, and must not wait for too long.
  if (thought_) run_.process().await(thought_, link::Process::Clock::now() + kPatienceOfOthers);
  ordered_.push_front(motion.m);
  if (ordered_.size() > kLoopDelay + 1) ordered_.pop_back();
  truth_.collect();
  note_rows(x);
  show(motion, x);
  run_.each_macrostep(x.i, seconds(x.i));
}

void RubikRun::note_rows(const X& x) {
  const int executed = ordered_.size() > kLoopDelay ? ordered_[kLoopDelay] : 0;
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const Report& r = x.T.agent[arm];
    if (!r.ready) continue;
    mp::ArmRow row;
    row.i = x.i;
    // x_ce was measured in step n_Q of the macrostep before the last.
    row.t = seconds(x.i - 2) + kPacing.n_Q * kPacing.dt;
    row.m = executed;
    row.pose = Eigen::Map<const Vector6>(r.T_0E.data());
    row.F = r.F_a;
    row.gap = r.gripper;
    row.blocked = r.blocked;
    record_.traces[arm].push_back(row);
  }
}

void RubikRun::show(const Motion<Coordinator>& motion, const X& x) {
  run_.set_state(motion.m == kWaitForStart.m ? TaskState::waiting_for_start
                 : motion.m == kResume.m     ? TaskState::paused
                                             : TaskState::running,
                 false);
  auto& board = run_.board();
  board.set_behaviour(motion.m, motion.name, motion.until);
  board.set_progress(progress_, doing_);
  for (std::size_t arm = 0; arm < kArms; ++arm) board.set_arm(arm, x.T.agent[arm], "");
}

}  // namespace mrroc::rubik
