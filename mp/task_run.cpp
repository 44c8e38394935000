#include "mp/task_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/joined.hpp"
#include "base/link/log_reader.hpp"
#include "base/link/lossy_bus.hpp"
#include "base/link/real_time.hpp"
#include "base/program.hpp"
#include "base/signals.hpp"
#include "mp/black_box.hpp"
#include "mp/hosts.hpp"
#include "mp/tell.hpp"
#include "mp/viewer.hpp"

namespace mrroc::mp {
namespace {

/// Macrosteps between the order to stop and the first macrostep without a command: far enough ahead that
/// nobody has passed it.
constexpr std::int64_t kStopAhead = 3;

/// Macrosteps that last so long leave time for a message to reach everybody within half of one: then a stop does not
/// wait for the coordinator's next macrostep.
constexpr std::chrono::milliseconds kPromptly{10};

/// Without a macrostep for so long, a stop does not wait for the next one.
constexpr std::chrono::seconds kStopPatience{2};

constexpr const char* kOperatorScript = "operator.script";

std::atomic<int> interrupts{0};
std::atomic<int> last_signal{0};
void interrupt(int signal) {
  last_signal = signal;
  ++interrupts;
}

/// Signals that stop the task, and their names.
constexpr std::array<std::pair<int, std::string_view>, 3> kStops{
    {{SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"}}};

/// From now on they stop it in a controlled way, unless the caller wants one ignored, as nohup does.
void take_signals() {
  for (const auto& [number, name] : kStops)
    if (std::signal(number, interrupt) == SIG_IGN) std::signal(number, SIG_IGN);
}

/// A macrostep at a slow pace is not a silent peer.
std::chrono::milliseconds patience_at(double speed) {
  if (link::kPatience.count() == 0 || speed <= 0) return link::kPatience;
  constexpr double kSlowest = 0.2;  // simulated duration of the longest wait [s]
  return link::kPatience + std::chrono::milliseconds(std::llround(1e3 * kSlowest / speed));
}

/// @return how long a macrostep lasts [wall time]; 0: as short as it can be
std::chrono::microseconds macrostep_at(const TaskOptions& options, const Config& config) {
  constexpr double kStep = 0.002;  // [s]
  const double speed = options.clock == ClockKind::wall ? 1 : options.speed;
  if (speed <= 0) return {};
  return std::chrono::microseconds(std::llround(1e6 * config.integer<int>("time.n_s", 10) * kStep / speed));
}

}  // namespace

TaskRun::TaskRun(const std::string& task, const TaskOptions& options, const std::filesystem::path& folder,
                 const std::vector<std::string>& arms, std::vector<Part> parts)
    : task_(task),
      folder_(folder),
      session_(options.session.empty() ? link::unique_session_name(task) : options.session),
      separate_(options.separate),
      view_(options.view),
      clock_(options.clock == ClockKind::wall ? "wall" : "step") {
  const Config config = Config::load(folder / "config.toml");
  open_bus(options, assign_hosts(read_hosts(config), parts));
  if (const double loss = link::read_loss(config); loss > 0) {
    lossless_ = std::move(bus_);
    bus_ = std::make_unique<link::LossyBus>(*lossless_, link::loses(loss, options.seed));
  }
  link::Membership membership{.session = session_,
                              .session_id = link::random_id(),
                              .name = "mp",
                              .roster = {"mp"},
                              .clock = options.clock,
                              .patience = patience_at(options.speed),
                              .macrostep = macrostep_at(options, config)};
  for (const Part& p : parts) membership.roster.push_back(p.name);
  survive_failed_writes();
  session_file_ =
      std::make_unique<link::SessionFile>(link::SessionInfo{.name = session_,
                                                            .id = membership.session_id,
                                                            .address = address_,
                                                            .task = task,
                                                            .run_folder = std::filesystem::absolute(folder)});
  log_ = std::make_unique<link::EventLog>(folder / link::kEventLog, membership.session_id);
  bus_->subscribe_all(session_ + ".", *log_);
  write_processes(parts);
  own_process_ = std::make_unique<link::Process>(*bus_, membership);
  process_ = own_process_.get();
  furnish(arms, std::move(parts), folder / "messages.log",
          options.script.empty() ? std::vector<ScriptedOrder>{} : load_script(options.script),
          folder / kOperatorScript);
  interrupts = 0;
  last_macrostep_ = link::Process::Clock::now();
  take_signals();
}

TaskRun::TaskRun(const std::string& task, link::Process& process, const std::filesystem::path& folder,
                 const std::vector<std::string>& arms)
    : task_(task), folder_(folder), session_(process.membership().session), process_(&process) {
  furnish(arms, {}, "/dev/null", load_script(folder / kOperatorScript), {});
  last_macrostep_ = link::Process::Clock::now();
}

void TaskRun::furnish(const std::vector<std::string>& arms, std::vector<Part> parts,
                      const std::filesystem::path& messages, std::vector<ScriptedOrder> script,
                      const std::filesystem::path& record) {
  supervisor_ = std::make_unique<Supervisor>(*process_, std::move(parts), messages);
  desk_ = std::make_unique<OperatorDesk>(*process_, std::move(script), record);
  board_ = std::make_unique<StatusBoard>(*process_, *supervisor_, task_, arms,
                                         std::filesystem::absolute(folder_).string());
  process_->on_service = [this] {
    supervisor_->poll();
    desk_->poll();
    board_->poll();
    look_after_orders();
  };
}

void TaskRun::write_processes(const std::vector<Part>& parts) const {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  const std::string self = this_program().filename().string();
  list.push_back({{"name", "mp"}, {"program", self}, {"arguments", nlohmann::ordered_json::array()}});
  for (const Part& p : parts)
    list.push_back({{"name", p.name}, {"program", p.program}, {"arguments", p.arguments}});
  write_text(folder_ / "processes.json",
             nlohmann::ordered_json{{"task", task_}, {"clock", clock_}, {"processes", list}}.dump(2) + "\n");
}

TaskRun::~TaskRun() {
  if (!own_process_) {
    process_->on_service = nullptr;
    return;
  }
  for (const auto& [number, name] : kStops)
    if (std::signal(number, SIG_DFL) == SIG_IGN) std::signal(number, SIG_IGN);
  process_->on_service = nullptr;
  if (board_) {
    set_state(TaskState::ended, false);
    board_->publish();
  }
}

void TaskRun::open_bus(const TaskOptions& options, bool several_hosts) {
  link::LcmAddress address =
      options.url.empty() ? link::address_for(session_) : link::LcmAddress::parse(options.url);
  if (several_hosts) {
    if (!separate_)
      throw FaultError(FaultCode::bad_usage,
                       "some processes are to run on other hosts, which --processes one does not allow");
    if (options.url.empty()) address.ttl = 1;
    if (address.ttl == 0)
      throw FaultError(FaultCode::bad_usage,
                       "nothing leaves this host with " + options.url + ", and some processes run on others",
                       "give --url with ttl=1, or none");
  }
  if (separate_ && !link::multicast_works(address)) {
    if (options.separate_asked)
      throw FaultError(FaultCode::no_multicast,
                       fmt::format("separate processes need multicast, and {} reaches nobody", address.host));
    tell("no multicast on this host: all in one process; ui_cli cannot attach");
    separate_ = false;
  }
  if (separate_) {
    bus_ = link::open_lcm(address);
    address_ = address;
    return;
  }
  hub_ = std::make_unique<link::MemoryHub>();
  bus_ = hub_->open();
}

void TaskRun::look_after_orders() {
  if (interrupts > signals_ && desk_->give(OperatorOrder::stop)) signal_ = last_signal;
  signals_ = interrupts;
  if (desk_->emergency()) {
    supervisor_->stop({.code = FaultCode::emergency_stop}, 0);
    desk_->repeat_emergency();
  }
  if (running_ && process_->membership().macrostep >= kPromptly && !process_->over()) stop_promptly();
  tell_lateness();
  const bool in_vain = link::Process::Clock::now() - last_macrostep_ > kStopPatience;
  if (desk_->stop_accepted() && (in_vain || signals_ > 1)) supervisor_->stop(stop_reason(), 0);
  if (log_ && log_->failed() && !supervisor_->fault())
    supervisor_->stop({.code = FaultCode::cannot_write, .text = "events.lcmlog in the run folder"},
                      running_ ? i_ + kStopAhead : 0);
}

// The first macrostep that the coordinator has not thought of begins in half of one at the earliest, see
// CoordinatorLinks::linger(): nobody has passed it.
void TaskRun::stop_promptly() {
  const std::int64_t as_of = i_ + 1;
  if (desk_->take_stop(as_of - kStopAhead)) supervisor_->stop(stop_reason(), as_of);
}

void TaskRun::tell_lateness() {
  constexpr std::chrono::seconds kApart{10};
  const auto now = link::Process::Clock::now();
  const std::int64_t late = supervisor_->skipped();
  if (late <= late_told_ || now - late_told_at_ < kApart || clock_ != "wall" || process_->over()) return;
  tell(fmt::format("late periods: {} more, {} in all; this host is too slow or too busy for --clock wall",
                   late - late_told_, late));
  late_told_ = late;
  late_told_at_ = now;
}

void TaskRun::start() {
  if (view_) tell(address_ ? start_viewer(session_) : "no viewer: all is in one process");
  if (hub_) {
    supervisor_->start_threads(*hub_);
  } else {
    const link::Membership& m = process_->membership();
    const bool paced = m.macrostep.count() > 0;
    if (paced) link::keep_in_memory();
    std::vector<std::string> words{
        "--session",
        m.session,
        "--session-id",
        std::to_string(m.session_id),
        "--url",
        address_->url(),
        "--roster",
        joined(m.roster, ","),
        "--clock",
        clock_,
        "--patience",
        std::to_string(std::chrono::duration<double>(m.patience).count()),
        "--config",
        std::filesystem::absolute(folder_ / "config.toml").string()};  // another host begins elsewhere
    if (paced) words.emplace_back("--paced");
    supervisor_->start_processes(words);
  }
}

// As fast as the machine can, nothing but waiting would fill the log with megabytes in a second. What is sent stays the
// same, and orders end the wait.
void TaskRun::wait_for_a_person(double macrostep_s) {
  if (!own_process_ || !process_->lock_step() || process_->membership().macrostep.count() > 0) return;
  const auto over = [this] { return !desk_->waits_for_a_person() || process_->over(); };
  process_->await(over, last_macrostep_ + std::chrono::microseconds(std::llround(1e6 * macrostep_s)));
}

void TaskRun::each_macrostep(std::int64_t i, double sim_s) {
  wait_for_a_person(sim_s - sim_s_);
  if (!running_) {
    running_ = true;
    begun_ = link::Process::Clock::now();
  }
  sim_s_ = sim_s;
  i_ = i;
  last_macrostep_ = link::Process::Clock::now();
  board_->set_time(i, sim_s);
  if (desk_->stop_ordered() && !process_->over()) supervisor_->stop(stop_reason(), i + kStopAhead);
}

Fault TaskRun::stop_reason() const {
  if (signal_ == 0) return {.code = FaultCode::operator_stop};
  const auto* const signal = std::ranges::find(kStops, signal_, &std::pair<int, std::string_view>::first);
  return {.code = FaultCode::interrupted, .text = signal == kStops.end() ? "a signal" : signal->second};
}

void TaskRun::survive(const Fault& fault, const std::string& advice) {
  const std::string process(fault.process.view());
  process_->say(fmt::format("{}; {}", what_happened(fault), advice), fault.code);
  survived_.push_back({fault, sim_s_});
  if (!log_ || survived_.size() > kMostBoxes) return;
  log_->flush();
  if (box_.valid()) box_.get();
  box_ = std::async(std::launch::async, [folder = folder_, roster = process_->membership().roster,
                                         within = fmt::format("{}-{}", process, i_)] {
    write_black_box(folder, roster, within);
  });
}

void TaskRun::finish(const std::function<void()>& work) {
  auto done = std::async(std::launch::async, work);
  process_->await([&] { return done.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
  done.get();
}

void TaskRun::set_state(TaskState state, bool waits_for_trigger) {
  desk_->set_state(state, waits_for_trigger);
  board_->set_state(state, waits_for_trigger);
}

Summary TaskRun::end(const std::optional<Fault>& fault) {
  const double wall_s = std::chrono::duration<double>(link::Process::Clock::now() - begun_).count();
  const std::int64_t late = supervisor_->skipped();  // processes that leave are not late
  if (fault) supervisor_->stop(*fault, 0);
  set_state(fault || supervisor_->fault() ? TaskState::stopping : TaskState::ended, false);
  board_->publish();
  process_->report_done();
  supervisor_->end();
  set_state(TaskState::ending, false);
  board_->publish();

  Summary summary;
  summary.task = task_;
  summary.survived = survived_;
  if (box_.valid()) box_.get();
  summary.fault = supervisor_->fault();
  if (!log_->flush() && !summary.fault)
    summary.fault = Fault{.code = FaultCode::cannot_write, .text = "events.lcmlog in the run folder"};
  summary.stopped = summary.fault && (summary.fault->code == FaultCode::operator_stop ||
                                      summary.fault->code == FaultCode::interrupted ||
                                      summary.fault->code == FaultCode::emergency_stop);
  summary.sim_s = sim_s_;
  summary.wall_s = running_ ? wall_s : 0;
  summary.log_hash = supervisor_->log_hash();
  if (const auto& steps = supervisor_->stop_steps(); summary.fault && steps[0] >= 0)
    summary.figures["stop_steps_max"] = static_cast<double>(*std::ranges::max_element(steps));
  if (summary.fault && (!summary.stopped || summary.fault->code == FaultCode::emergency_stop))
    summary.black_box = write_black_box(folder_, process_->membership().roster);
  else if (!survived_.empty())
    summary.black_box = black_box_files(folder_);
  if (clock_ == "wall") summary.figures["late_periods"] = static_cast<double>(late);
  if (log_->gaps() > 0) summary.figures["log_gaps"] = static_cast<double>(log_->gaps());
  return summary;
}

}  // namespace mrroc::mp
