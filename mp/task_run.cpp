#include "mp/task_run.hpp"

#include <fmt/core.h>

#include <chrono>
#include <future>

#include "base/signals.hpp"
#include "mp/run_end.hpp"
#include "mp/viewer.hpp"

namespace mrroc::mp {
namespace {

constexpr const char* kOperatorScript = "operator.script";

}  // namespace

TaskRun::TaskRun(const std::string& task, const TaskOptions& options, const std::filesystem::path& folder,
                 const std::vector<std::string>& arms, std::vector<NodeSpec> nodes) try
    : task_(task),
      folder_(folder),
      view_(options.view),
      scripted_(!options.script.empty()),
      max_time_(options.max_time) {
  const Config config = Config::load(folder / "config.toml");
  session_ = std::make_unique<RunSession>(task, options, folder, config, nodes);
  report_failed_writes();
  log_ = std::make_unique<RunLog>(folder, session_->bus(), session_->context(), config);
  session_->write_processes(nodes);
  own_process_ = std::make_unique<link::Process>(session_->bus(), session_->context());
  process_ = own_process_.get();
  create_services(arms, std::move(nodes), folder / "messages.log", options.session,
                  options.script.empty() ? std::vector<ScriptedOrder>{} : load_script(options.script),
                  folder / kOperatorScript);
  signals_ = std::make_unique<SignalOrders>(*command_server_, *supervisor_, *process_);
} catch (...) {
  discard_run_folder(folder);  // the next try may use its name
  throw;
}

TaskRun::TaskRun(const std::string& task, link::Process& process, const std::filesystem::path& folder,
                 const std::vector<std::string>& arms)
    : task_(task), folder_(folder), process_(&process) {
  create_services(arms, {}, "/dev/null", {}, load_script(folder / kOperatorScript), {});
}

void TaskRun::create_services(const std::vector<std::string>& arms, std::vector<NodeSpec> nodes,
                              const std::filesystem::path& messages, const std::string& session,
                              std::vector<ScriptedOrder> script, const std::filesystem::path& record) {
  supervisor_ = std::make_unique<Supervisor>(*process_, std::move(nodes), messages);
  command_server_ = std::make_unique<OperatorCommandServer>(*process_, std::move(script), record);
  board_ = std::make_unique<StatusBoard>(*process_, *supervisor_, task_, arms,
                                         std::filesystem::absolute(folder_).string());
  supervisor_->on_alarm = [](const std::string& line) { print_line(line); };
  announce_ = std::make_unique<Announcer>(*process_, session, own_process_ != nullptr);
  recoverable_ = std::make_unique<RecoverableFaults>(*process_, folder_, log_.get());
  stops_ = std::make_unique<StopOrders>(*command_server_, *supervisor_, *process_, [this] {
    return signals_ ? signals_->stop_reason() : Fault{.code = FaultCode::operator_stop};
  });
  wait_ =
      std::make_unique<OrderWait>(*process_, *command_server_, *board_, *supervisor_, *announce_, scripted_);
  process_->on_service = [this] { serve(); };
}

TaskRun::~TaskRun() {
  signals_.reset();
  process_->on_service = nullptr;
  if (!own_process_ || !board_) return;
  set_state(TaskState::ended, false);
  board_->publish();
}

void TaskRun::start() {
  if (view_) print_line(session_->alone() ? "no viewer: all is in one process" : start_viewer(session()));
  session_->start(*supervisor_);
}

void TaskRun::serve() {
  supervisor_->poll();
  command_server_->poll();
  board_->poll();
  if (signals_) signals_->look();
  stops_->look(signals_ && signals_->impatient());
  print_lateness();
  if (own_process_ && begun_) wait_->look();
  look_after_log();
}

void TaskRun::look_after_log() {
  if (!log_) return;
  if (log_->failed() && !supervisor_->fault())
    supervisor_->stop(log_fault(), begun_ ? i_ + StopOrders::kAhead : 0);
  const std::optional<std::string> line = log_->news(i_);
  if (!line) return;
  process_->log(*line);
  print_line(*line);
}

void TaskRun::print_lateness() {
  if (!own_process_ || process_->lock_step() || process_->over()) return;
  if (const auto line = lateness_.look(Clock::now(), supervisor_->skipped())) print_line(*line);
}

void TaskRun::end_in_time(double sim_s) {
  if (max_time_ <= 0 || sim_s < max_time_ || process_->over()) return;
  supervisor_->stop(
      {.code = FaultCode::time_limit, .text = fmt::format("{:g} s; {}", max_time_, what(wait_->wait()))},
      i_ + StopOrders::kAhead);
}

void TaskRun::each_macrostep(std::int64_t i, double sim_s) {
  if (own_process_) wait_->let_last(sim_s);
  if (!begun_) begun_ = Clock::now();
  sim_s_ = sim_s;
  i_ = i;
  wait_->each_macrostep(i, sim_s);
  board_->set_time(i, sim_s);
  stops_->each_macrostep(i);
  end_in_time(sim_s);
}

void TaskRun::set_state(TaskState state, bool waits_for_trigger) {
  command_server_->set_state(state, waits_for_trigger);
  board_->set_state(state, waits_for_trigger);
}

void TaskRun::finish(const std::function<void()>& work) {
  signals_->set_finishing(true);
  auto done = std::async(std::launch::async, work);
  process_->await([&] { return done.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
  signals_->set_finishing(false);
  done.get();
}

Summary TaskRun::end(Outcome outcome, const std::optional<Fault>& fault) {
  EndedRun run{.task = task_,
               .folder = folder_,
               .roster = process_->context().roster,
               .outcome = outcome,
               .sim_s = sim_s_,
               .wall_s = begun_ ? std::chrono::duration<double>(Clock::now() - *begun_).count() : 0};
  if (!process_->lock_step()) run.late = supervisor_->skipped();  // processes that leave are not late
  if (fault)
    supervisor_->stop(*fault, 0);
  else if (outcome != Outcome::terminated && !supervisor_->fault())
    supervisor_->stop(*why_not_done(*supervisor_, outcome), 0);
  set_state(fault || supervisor_->fault() ? TaskState::stopping : TaskState::ended, false);
  board_->publish();
  process_->report_done();
  supervisor_->end();
  stops_->settle();
  set_state(TaskState::ending, false);
  board_->publish();
  run.survived = recoverable_->finish();
  return summarize(run, *supervisor_, *log_);
}

}  // namespace mrroc::mp
