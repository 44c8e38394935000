#include "tasks/rubik/rubik_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>

#include "tasks/rubik/config.hpp"

namespace mrroc::rubik {
namespace {

/// From an order of the coordinator to the report about its execution (MG 11-15).
constexpr std::size_t kLoopDelay = 3;

/// Wall time that a macrostep of thinking may take.
constexpr std::chrono::seconds kPatienceOfOthers{3};

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
      truth_(run.process()),
      announce_(std::move(announce)) {}

double RubikRun::seconds(std::int64_t macrosteps) const {
  return static_cast<double>(macrosteps) * kPacing.macrostep_s();
}

Outcome RubikRun::execute() {
  Port port(links_, [this](const auto& motion, const X& x) { observe(motion, x); });
  X x;
  x.c.k = k_;
  Outcome o = links_.begin({.m = kWait});
  if (o == Outcome::terminated) {
    port.read(x);
    o = work(x, port);
  }
  if (o == Outcome::terminated) links_.send(std::vector<Order>(kArms, Order{.m = kWait, .finished = true}));
  if (o == Outcome::faulted && !fault_) fault_ = links_.fault();
  return o;
}

template <class T>
Outcome RubikRun::think(X& x, Port& port, std::function<T()> work, std::optional<T>& result) {
  auto thought = std::async(std::launch::async, std::move(work));
  thought_ = [&thought] { return thought.wait_for(std::chrono::seconds(0)) == std::future_status::ready; };
  const Outcome o = move(kThink, x, port);
  if (o == Outcome::terminated) run_.process().await(thought_);
  thought_ = {};
  if (o == Outcome::terminated) result = thought.get();
  return o;
}

Outcome RubikRun::work(X& x, Port& port) {
  Program<Port> program(x, port, record_.journal);
  doing_ = "wait for start";
  Outcome o = program.wait_for_start();
  if (o != Outcome::terminated) return o;

  struct Thought {
    Moves solution;
    Planned planned;
  };
  doing_ = "thinking";
  std::optional<Thought> thought;
  o = think<Thought>(
      x, port,
      [this] {
        Thought t;
        t.solution = brain_.solve(*brain_.known);
        t.planned = brain_.plan(brain_.start, t.solution);
        return t;
      },
      thought);
  if (o != Outcome::terminated) return o;
  if (!thought->planned.plan) return fail(FaultCode::no_plan, thought->planned.text);
  record_.solution = thought->solution;
  const Plan& plan = *thought->planned.plan;
  say(fmt::format("solution: {} turns: {}; {} re-grasps, about {:.0f} s", plan.turns.size(),
                  to_string(plan.turns), plan.regrasps, plan.seconds));
  record_.planned_s = plan.seconds;
  return execute_plan(plan, x, program);
}

Outcome RubikRun::execute_plan(const Plan& plan, X& x, Program<Port>& program) {
  record_.solving = x.i;
  std::size_t turn = 0;
  for (const Step& step : plan.steps) {
    if (step.turn) ++turn;
    progress_ = plan.seconds > 0 ? static_cast<double>(turn) / static_cast<double>(plan.turns.size() + 1) : 0;
    doing_ = step.turn    ? fmt::format("move {} of {}: {}", turn, plan.turns.size(), to_string(*step.turn))
             : step.shows ? fmt::format("show {}", letter(*step.shows))
                          : fmt::format("re-grasp before move {}", turn + 1);
    say(doing_);
    const Outcome o = program.execute(step);
    const CycleNote& note = record_.journal.back();
    if (note.grips > 1) say(fmt::format("gripped at attempt {}", note.grips));
    if (note.attempts > 1) say(fmt::format("turned at attempt {}", note.attempts));
    if (o == Outcome::faulted && program.trouble() != Trouble::none)
      return fail(code_of(program.trouble()), fmt::format("{}: {}", doing_, to_string(program.trouble())));
    if (o != Outcome::terminated) return o;
  }
  record_.solved = x.i;
  progress_ = 1;
  return Outcome::terminated;
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
  board.set_behaviour(motion.m, motion.name);
  board.set_progress(progress_, doing_);
  for (std::size_t arm = 0; arm < kArms; ++arm) board.set_arm(arm, x.T.agent[arm], "");
}

}  // namespace mrroc::rubik
