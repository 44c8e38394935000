#include "test/tasks/drawing/driven_drawing.hpp"

#include "ecp/generators/commands.hpp"
#include "ecp/generators/rows.hpp"
#include "mp/trace_recorder.hpp"
#include "tasks/drawing/program.hpp"
#include "test/rig/driven_cell.hpp"
#include "test/rig/irb6_cell.hpp"

namespace mrroc::test {
namespace {

using namespace drawing;
using X = Coordinator::X;

constexpr double kLedArms = 30;  // swing of an unstable contact, as in drawing.toml [N]
constexpr double kDelay = latency::kMotionToReport * 0.02;  // from a reading to the coordinator [s]
constexpr int kBiasing = 60;  // macrosteps until the force is biased and the arm has been at rest
constexpr int kSteady = 25;   // macrosteps that a hand holds still before the trigger

sim::WorldParameters world_of(const DrivenDrawing& d) {
  sim::WorldParameters world = rig::irb6_cell();
  if (!d.copies) world.arms.pop_back();
  for (sim::ArmParameters& arm : world.arms) {
    const Pose place = arm.paper.T_0P;
    arm.paper = d.paper;
    arm.paper.T_0P = place;
    arm.hand = d.hand;
  }
  return world;
}

edp::OscillationParameters oscillation_of(const DrivenDrawing& d) {
  edp::OscillationParameters p;
  p.force = d.oscillation_force > 0 ? d.oscillation_force : kLedArms;
  return p;
}

Ink ink_on(const sim::World& world, int arm) {
  Ink ink;
  for (const sim::InkPoint& p : world.ink(arm)) ink.push_back({p.stroke, p.t, p.x, p.y});
  return ink;
}

// Coordinator's port, agents and operator. An order is read by the agents one macrostep after it was made, and so is
// a report by the coordinator.
class Cell {
 public:
  explicit Cell(const DrivenDrawing& d)
      : d_(d),
        cell_(world_of(d), d.seed, {}, oscillation_of(d)),
        sensors_(kArms, vsp::PenStateSensor(d.sensor)),
        recorder_(arms(), mp::TraceNumbers::coordinator, sim::kStep, 10) {
    cell_.watch([this] {
      for (std::size_t arm = 0; arm < arms(); ++arm) {
        const edp::Driver& driver = cell_.driver(static_cast<int>(arm));
        if (driver.reply_due())
          for (const edp::MeasuredStep& step : driver.samples()) sensors_[arm].step(step.sample());
      }
      if (d_.watch) d_.watch(cell_.world(), sensors_, m_);
    });
    for (Order& order : orders_) order.arm.n_Q = 9;
    for (std::size_t arm = 0; arm < arms(); ++arm) cell_.send(static_cast<int>(arm), ecp::bias_force());
    for (int k = 0; k < kBiasing; ++k) (void)cell_.wait();
  }

  void dispatch(const Motion<Coordinator>& motion, const Coordinator::Y& y) {
    if (motion.m != m_) enter(motion.m);
    std::ranges::copy(y.T, made_.begin());
  }

  Outcome wait() {
    for (std::size_t arm = 0; arm < arms(); ++arm) {
      Arm::X x;
      x.e = cell_.reply(static_cast<int>(arm));
      x.V = readings_[arm];
      x.T = orders_[arm];
      told_[arm] = ecp::report_of(x, x.T.m);
      cell_.send(static_cast<int>(arm), ecp::copied_order(x));
    }
    orders_ = made_;
    if (cell_.wait() == Outcome::faulted) {
      for (std::size_t arm = 0; arm < arms(); ++arm)
        if (const Fault f = cell_.reply(static_cast<int>(arm)).fault; f) fault = f;
      return Outcome::faulted;
    }
    for (std::size_t arm = 0; arm < arms(); ++arm) readings_[arm] = sensors_[arm].reading();
    follow_hands();
    if (fault) return Outcome::faulted;
    return seconds() < d_.longest_s ? Outcome::terminated : Outcome::aborted;
  }

  void read(X& x) {
    x.i = cell_.i();
    for (Report& report : told_) report.ready = true;
    x.T.agent.assign(told_.begin(), told_.end());
    x.T.h.started = true;
    x.T.h.trigger = trigger_;
    clock_.advance(false);
    x.t = clock_.now();
    record(x);
  }

  [[nodiscard]] double seconds() const { return static_cast<double>(cell_.world().steps()) * sim::kStep; }
  [[nodiscard]] const sim::World& world() const { return cell_.world(); }
  std::optional<Ink> taught;
  RunRecord log;
  Fault fault;

 private:
  [[nodiscard]] std::size_t arms() const { return static_cast<std::size_t>(cell_.world().arms()); }

  void enter(int m) {
    sim::World& world = cell_.world();
    if (m == 1) world.hand(0).lead_along(d_.drawing);
    if (m == 3) {
      taught = without_hops(ink_on(world, 0));
      world.new_sheet(0);
      for (int arm = 0; arm < world.arms(); ++arm) world.hand(arm).lead_to(d_.drawing.front().front());
    }
    if (m == 4)
      for (int arm = 0; arm < world.arms(); ++arm) world.hand(arm).release();
    m_ = m;
    steady_ = 0;
    given_ = false;
  }

  void follow_hands() {
    if (m_ != 1 && m_ != 2 && m_ != 3) return;
    bool done = true;
    for (int arm = 0; arm < (m_ == 3 ? cell_.world().arms() : 1); ++arm)
      done = done && cell_.world().hand(arm).status().phase == sim::HandPhase::done;
    steady_ = done ? steady_ + 1 : 0;
    if (steady_ < kSteady || given_) return;
    if (m_ == 1) fault = {.code = FaultCode::no_contact, .text = "led along the whole drawing in vain"};
    given_ = true;
    ++trigger_;
  }

  void record(const X& x) {
    recorder_.note(x.i, m_, told_);
    recorder_.add_rows(log.traces);
    note_nodes(log, x.c.recording, seconds() - kDelay);
    for (std::size_t arm = 0; arm < arms(); ++arm) {
      log.traces[arm].back().t = seconds();  // the simulator's clock, in which ink is timed
      const int executed = recorder_.executed(arm);
      const bool on_paper = static_cast<PenState>(x.T.agent[arm].sensor) == PenState::paper_surface;
      log.mismatches[arm] += (executed == 5 && !on_paper) || (executed == 7 && on_paper);
    }
  }

  const DrivenDrawing& d_;
  rig::DrivenCell cell_;
  std::vector<vsp::PenStateSensor> sensors_;
  std::array<SensorReading, kArms> readings_{};
  std::array<Order, kArms> made_{}, orders_{};
  std::array<Report, kArms> told_{};
  mp::TraceRecorder recorder_;
  TaskClock clock_ = TaskClock::ramped();
  int m_{};
  int steady_{};
  bool given_{};
  std::int64_t trigger_{};
};

}  // namespace

DrivenResult run(const DrivenDrawing& d) {
  Cell cell(d);
  X x;
  x.c.recording = Recording(x.c.k.dt * x.c.k.n_s);
  cell.read(x);
  DrivenResult r;
  if (d.copies) {
    r.outcome = run_program(x, cell);
  } else {
    r.outcome = move(kWaitForStart, x, cell);
    for (const int m : {1, 2})
      if (r.outcome == Outcome::terminated)
        r.outcome = move(kCoordinator[static_cast<std::size_t>(m - 1)], x, cell);
    cell.taught = without_hops(ink_on(cell.world(), 0));
  }
  r.fault = cell.fault;
  r.record = std::move(cell.log);
  r.record.recording = x.c.recording;
  r.ink.taught = cell.taught;
  if (d.copies)
    for (std::size_t arm = 0; arm < kArms; ++arm)
      r.ink.drawn[arm] = ink_on(cell.world(), static_cast<int>(arm));
  r.simulated_s = cell.seconds();
  return r;
}

}  // namespace mrroc::test
