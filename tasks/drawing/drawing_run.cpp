#include "tasks/drawing/drawing_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/counted.hpp"
#include "tasks/drawing/doubtful.hpp"
#include "tasks/drawing/playback.hpp"
#include "tasks/drawing/program.hpp"

namespace mrroc::drawing {
namespace {

constexpr int kTeachIn = 2;  // m of its last behaviour

/// Strokes among the first p nodes.
int strokes_until(const Recording& recording, std::size_t p) {
  int strokes = 0;
  bool on_paper = false;
  for (std::size_t n = 0; n < std::min(p, recording.size()); ++n) {
    const bool paper = recording[n].pen == PenState::paper_surface;
    if (paper && !on_paper) ++strokes;
    on_paper = paper;
  }
  return strokes;
}

/// Why a trigger would come early in m = 2 or 3.
std::string still_busy(int m, double progress) {
  return m == 2 ? fmt::format("the hand is still drawing: {:.0f} %", std::floor(100 * progress))
                : "the hands are still leading the pens to the start";
}

/// Names the first arm whose pen is not on the paper.
Fault no_contact_fault(const Coordinator::X& x) {
  const bool first = static_cast<PenState>(x.T.agent[0].sensor) != PenState::paper_surface;
  Fault fault;
  fault.code = FaultCode::no_contact;
  fault.process = first ? "vsp-arm1" : "vsp-arm2";
  fault.text =
      fmt::format("arm{} was lowered and its pen-state sensor did not tell of the paper", first ? 1 : 2);
  return fault;
}

/// Names an arm that believes to draw and is off its sheet.
Fault off_the_sheet_fault(std::size_t arm) {
  Fault fault;
  fault.code = FaultCode::no_contact;
  fault.process = fmt::format("vsp-arm{}", arm + 1);
  fault.text = fmt::format(
      "arm{} tells of a force, but is not where its pen met the sheet: its force sensor drifts, or the sheet "
      "has moved",
      arm + 1);
  return fault;
}

}  // namespace

void note_nodes(RunRecord& record, const Recording& recording, double t) {
  auto& times = record.node_t;
  if (recording.size() < times.size())  // a touch that was none has been left out
    times.erase(times.begin(), times.end() - static_cast<std::ptrdiff_t>(recording.size()));
  times.resize(recording.size(), t);
}

DrawingRun::DrawingRun(mp::TaskRun& run, const std::vector<std::string>& arms, const Parameters& parameters,
                       const HandPlan& plan, std::optional<Recording> taught)
    : run_(run),
      k_(parameters),
      operator_(run.process(), run.command_server(), plan),
      links_(run.process(), arms, operator_, TaskClock::ramped(parameters.pause)),
      effectors_(arms.size()),
      recorder_(effectors_, mp::TraceNumbers::coordinator, parameters.dt, parameters.n_s) {
  record_.traces.resize(effectors_);
  taught_here_ = !taught;
  if (taught) record_.recording = *taught;
}

double DrawingRun::seconds(std::int64_t macrosteps) const {
  return static_cast<double>(macrosteps) * k_.n_s * k_.dt;
}

Outcome DrawingRun::execute() {
  mp::CoordinatorPort<Coordinator, std::function<void(const Motion<Coordinator>&, const X&)>> port(
      links_, [this](const auto& motion, const X& x) { observe(motion, x); });
  X x;
  x.T.agent.resize(effectors_);
  x.c.k = k_;
  x.c.recording = record_.recording;
  Order first;
  first.arm.n_s = static_cast<std::uint16_t>(k_.n_s);
  first.arm.n_Q = static_cast<std::uint16_t>(k_.n_s - 1);
  if (const Outcome o = links_.begin(first); o != Outcome::terminated) {
    fault_ = links_.fault();
    return o;
  }
  port.read(x);
  const Outcome outcome = run_program(x, port);
  record_.recording = x.c.recording;
  if (outcome != Outcome::terminated) {
    // What the links have seen comes first: no_contact is about m = 4 and 5 alone.
    fault_ = links_.fault();
    if (!fault_ && outcome == Outcome::faulted) {
      const std::optional<std::size_t> off = arm_off_its_sheet(x);
      if (no_contact(x))
        fault_ = no_contact_fault(x);
      else if (off)
        fault_ = off_the_sheet_fault(*off);
    }
    return outcome;
  }
  first.finished = true;
  links_.send(std::vector<Order>(effectors_, first));
  run_.board().set_progress(1, fmt::format("all of {} drawn", counted(record_.recording.size(), "node")));
  return outcome;
}

void DrawingRun::observe(const Motion<Coordinator>& motion, const X& x) {
  const double now = seconds(x.i);
  record_.whole = record_.whole || motion.m > kTeachIn;
  recorder_.note(x.i, motion.m, x.T.agent);
  if (taught_here_) note_nodes(record_, x.c.recording, recorder_.measured_at(x.i - 1));
  note_rows(x);
  record_.belt.note(x, motion.m);
  show(motion, x);
  run_.each_macrostep(x.i, now);
  if (operator_.in_vain() && !run_.process().over())
    run_.supervisor().stop(
        {.code = FaultCode::no_contact,
         .process = "vsp-arm1",
         .text = "the hand has led the pen along the whole drawing, and the pen-state sensor did not "
                 "tell of the paper; if it lands gently, lower pen_state.stop_force"},
        0);
}

void DrawingRun::note_rows(const X& x) {
  recorder_.add_rows(record_.traces);
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const Report& r = x.T.agent[arm];
    const int executed = recorder_.executed(arm);
    const bool on_paper = static_cast<PenState>(r.sensor) == PenState::paper_surface;
    record_.mismatches[arm] += (executed == 5 && !on_paper) || (executed == 7 && on_paper);
    // The verdict is on the order that the report before was about.
    if (reported_m_[arm] != 5) drawing_[arm] = false;
    if (reported_m_[arm] == 5 && r.verdict == Verdict::executed && !drawing_[arm]) {
      record_.segment_starts[arm].push_back(x.i);
      drawing_[arm] = true;
    }
    reported_m_[arm] = r.m;
  }
}

void DrawingRun::show(const Motion<Coordinator>& motion, const X& x) {
  const auto& c = x.c;
  if (motion.m != m_) {
    if (motion.m == 4) stroke_ = strokes_until(c.recording, static_cast<std::size_t>(c.p)) + 1;
    const std::string stroke = motion.m >= 4 ? fmt::format("  (stroke {} of {})", stroke_,
                                                           strokes_until(c.recording, c.recording.size()))
                                             : "";
    const bool ask = operator_.waits_for_orders() && (motion.m == 2 || motion.m == 3);
    run_.announce()(seconds(x.i), fmt::format("m = {}  {}{}{}", motion.m, motion.name, stroke,
                                              ask ? "  (until the operator's trigger)" : ""));
    if (motion.m == 4 && m_ == 3)
      if (const int doubtful = doubtful_strokes(c.recording); doubtful > 0)
        run_.announce()(seconds(x.i),
                        fmt::format("warning: the memory is doubtful in {}: pen states that do not fit the "
                                    "height of the pen; look at the taught ink before you trust the copies",
                                    counted(doubtful, "place")));
    m_ = motion.m;
    told_done_ = false;
  }
  const bool waits = motion.m == 2 || motion.m == 3;
  run_.set_state(motion.m == 0             ? TaskState::waiting_for_start
                 : links_.clock().paused() ? TaskState::paused
                                           : TaskState::running,
                 waits);
  run_.command_server().set_trigger_due(waits && operator_.done() && operator_.waits_for_orders());
  auto& board = run_.board();
  board.set_early(operator_.done() || !waits ? "" : still_busy(motion.m, operator_.progress()));
  if (waits && !told_done_ && operator_.done() && operator_.waits_for_orders()) {
    told_done_ = true;
    run_.announce()(seconds(x.i), "the hand is done; a trigger goes on (key t, or `ui_cli trigger`)");
  }
  board.set_behaviour(motion.m, motion.name, motion.until);
  const double nodes = static_cast<double>(c.recording.size());
  if (motion.m >= 4) {
    board.set_progress(nodes > 0 ? 0.5 + 0.5 * c.p / nodes : 0.5,
                       fmt::format("node {:.0f} of {:.0f}", c.p, nodes));
  } else {
    board.set_progress(motion.m <= 2 ? 0.5 * operator_.progress() : 0.5,
                       counted(c.recording.size(), "node") + " taught");
  }
  for (std::size_t arm = 0; arm < kArms; ++arm)
    board.set_arm(arm, x.T.agent[arm], to_string(static_cast<PenState>(x.T.agent[arm].sensor)));
  if (x.has_conveyor()) board.set_arm(kConveyor, x.T.agent[kConveyor], "");
}

}  // namespace mrroc::drawing
