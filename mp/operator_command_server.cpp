#include "mp/operator_command_server.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "base/fault.hpp"
#include "base/link/text.hpp"
#include "base/text_file.hpp"

namespace mrroc::mp {
namespace {

constexpr std::size_t kRememberedAnswers = 64;

/// Of MP's own orders: nobody waits for their answer.
constexpr std::int64_t kNoAnswer = 0;
constexpr std::chrono::milliseconds kRepeatEmergency{20};
constexpr std::string_view kOperator = "operator";

std::optional<OperatorOrder> order_named(std::string_view name) {
  for (const OperatorOrder o : kOperatorOrders)
    if (to_string(o) == name) return o;
  return std::nullopt;
}

bool stops(OperatorOrder order) {
  return order == OperatorOrder::stop || order == OperatorOrder::emergency_stop;
}

}  // namespace

std::vector<ScriptedOrder> load_script(const std::filesystem::path& file) {
  constexpr std::size_t kLargestScript = 1'000'000;
  std::istringstream in(read_input_file(file, kLargestScript, FaultCode::bad_script));
  std::vector<ScriptedOrder> script;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line = line.substr(0, line.find('#'));
    std::istringstream words(line);
    ScriptedOrder s;
    std::string name, rest;
    if (!(words >> s.i) || !std::isspace(words.peek())) {
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      throw FaultError(FaultCode::bad_script,
                       fmt::format("{}:{}: a line is MACROSTEP ORDER", file.string(), number));
    }
    words >> name;
    const auto order = order_named(name);
    if (!order || s.i < 1 || words >> rest)
      throw FaultError(
          FaultCode::bad_script,
          fmt::format(
              "{}:{}: '{}' is not an order; the orders are start, pause, resume, trigger, stop and e-stop, "
              "after a macrostep of at least 1",
              file.string(), number, line));
    s.order = *order;
    script.push_back(s);
  }
  std::ranges::stable_sort(script, {}, &ScriptedOrder::i);
  return script;
}

OperatorCommandServer::OperatorCommandServer(link::Process& process, std::vector<ScriptedOrder> script,
                                             const std::filesystem::path& record)
    : process_(process),
      order_in_(process.bus(), process.route("operator"), process.context().session_id),
      answer_out_(process.bus(), process.route("answer"), process.context().session_id),
      order_out_(process.bus(), process.route("operator"), process.context().session_id),
      script_(script.begin(), script.end()) {
  if (!record.empty()) {
    record_.open(record);
    record_ << "# Orders of the operator: macrostep and order. Replay with --script.\n";
  }
}

std::optional<std::string> OperatorCommandServer::refusal_reason(OperatorOrder order) const {
  const auto is = [this](TaskState s) { return state_ == s; };
  const auto waiting = [this](OperatorOrder o) { return std::ranges::find(waiting_, o) != waiting_.end(); };
  if (waiting(order)) return fmt::format("{} has just been ordered", to_string(order));
  switch (order) {
    case OperatorOrder::start:
      if (image_.started) return "the task has been started already";
      if (is(TaskState::waiting_for_start)) return std::nullopt;
      return fmt::format("the task is {}, it does not wait for a start", to_string(state_));
    case OperatorOrder::pause:
      if (is(TaskState::running)) return std::nullopt;
      return fmt::format("the task is {}, only a running one can be paused", to_string(state_));
    case OperatorOrder::resume:
      if (is(TaskState::paused)) return std::nullopt;
      return fmt::format("the task is {}, only a paused one can be resumed", to_string(state_));
    case OperatorOrder::trigger:
      if (!is(TaskState::running))
        return fmt::format("the task is {}, a trigger needs a running one", to_string(state_));
      if (!waits_for_trigger_ && m_ == 0) return "the task does not wait for a trigger";
      if (!waits_for_trigger_) return fmt::format("behaviour {} does not wait for a trigger", m_);
      return std::nullopt;
    case OperatorOrder::stop:
      if (state_ < TaskState::stopping) return std::nullopt;
      return fmt::format("the task is {} already", to_string(state_));
    case OperatorOrder::emergency_stop:
      if (emergency_) return "the emergency stop has been pressed already";
      if (state_ < TaskState::ending) return std::nullopt;
      return fmt::format("the task is {} already, and everything rests", to_string(state_));
  }
  return "there is no such order";
}

void OperatorCommandServer::poll() {
  while (const auto order = order_in_.take()) answer(*order);
}

void OperatorCommandServer::answer(const operator_order_t& m) {
  if (m.id == kNoAnswer) return;
  const auto known = std::ranges::find(answers_, m.id, &operator_answer_t::id);
  if (known != answers_.end()) {
    answer_out_.publish(*known, 0);
    return;
  }
  const bool exists = m.order >= 0 && m.order < static_cast<int>(kOperatorOrders.size());
  const auto order = static_cast<OperatorOrder>(m.order);
  const auto reason = exists ? refusal_reason(order) : "there is no such order";
  operator_answer_t answer{};
  answer.id = m.id;
  answer.accepted = !reason;
  // That everybody obeys a stop is told when everybody has said so; that the task is started, paused or goes on, when it is
  // so: the next order may build on it.
  answer.pending = !reason && order != OperatorOrder::trigger;
  link::put_text(answer.text, reason ? *reason
                              : stops(order)
                                  ? fmt::format("{}: not every process has confirmed it", to_string(order))
                                  : fmt::format("{} accepted", to_string(order)));
  if (!reason) accept(order);
  if (answer.pending) pending_.emplace_back(m.id, order);
  answers_.push_back(answer);
  if (answers_.size() > kRememberedAnswers) answers_.pop_front();
  answer_out_.publish(answer, 0);
}

bool OperatorCommandServer::stop_waits() const {
  return std::ranges::any_of(pending_, stops, &std::pair<std::int64_t, OperatorOrder>::second);
}

void OperatorCommandServer::settle_stops(const Fault& failure, const std::string& who) {
  settle(true, failure, ": " + who);
}

void OperatorCommandServer::settle(bool of_stops, const Fault& failure, const std::string& how) {
  std::erase_if(pending_, [&](const auto& pending) {
    const auto [id, order] = pending;
    if (stops(order) != of_stops) return false;
    const auto answer = std::ranges::find(answers_, id, &operator_answer_t::id);
    if (answer == answers_.end()) return true;
    answer->pending = 0;
    answer->accepted = failure.code == FaultCode::none;
    answer->code = static_cast<std::int32_t>(failure.code);
    link::put_text(answer->text, answer->accepted
                                     ? fmt::format("{} accepted{}", to_string(order), how)
                                     : fmt::format("{}: {}", to_string(order), failure.text.view()));
    answer_out_.publish(*answer, 0);
    return true;
  });
}

bool OperatorCommandServer::give(OperatorOrder order, std::string_view by) {
  if (refusal_reason(order)) return false;
  if (order == OperatorOrder::stop) stop_by_ = by;
  accept(order);
  return true;
}

void OperatorCommandServer::accept(OperatorOrder order) {
  if (order == OperatorOrder::emergency_stop)
    obey(order, i_ + 1);  // no macrostep has to come
  else
    waiting_.push_back(order);
}

void OperatorCommandServer::repeat_emergency() {
  const auto now = link::Process::Clock::now();
  if (!emergency_ || now - repeated_ < kRepeatEmergency) return;
  repeated_ = now;
  order_out_.publish(
      {.header = {}, .id = kNoAnswer, .order = static_cast<std::int32_t>(OperatorOrder::emergency_stop)}, i_);
}

OperatorImage OperatorCommandServer::take(std::int64_t i) {
  i_ = std::max(i_, i - 1);
  for (; !script_.empty() && script_.front().i <= i; script_.pop_front()) {
    const OperatorOrder order = script_.front().order;
    const auto reason = refusal_reason(order);
    if (!reason) accept(order);
    if (reason)
      process_.log(fmt::format("script: {} in macrostep {} is refused, {}", to_string(order), i, *reason),
                   FaultCode::bad_script);
  }
  for (const OperatorOrder order : waiting_) obey(order, i);
  waiting_.clear();
  i_ = i;
  return image_;
}

bool OperatorCommandServer::take_stop(std::int64_t i) {
  if (std::erase(waiting_, OperatorOrder::stop) == 0) return false;
  obey(OperatorOrder::stop, std::max<std::int64_t>(1, i));
  return true;
}

void OperatorCommandServer::obey(OperatorOrder order, std::int64_t i) {
  switch (order) {
    case OperatorOrder::start:
      image_.started = true;
      break;
    case OperatorOrder::pause:
      image_.paused = true;
      break;
    case OperatorOrder::resume:
      image_.paused = false;
      break;
    case OperatorOrder::trigger:
      ++image_.trigger;
      trigger_due_ = false;
      break;
    case OperatorOrder::stop:
      stop_ = true;
      break;
    case OperatorOrder::emergency_stop:
      emergency_ = true;
      break;
  }
  const std::string by = order == OperatorOrder::stop ? stop_by_ : std::string(kOperator);
  record_ << i << ' ' << to_string(order) << (by == kOperator ? "" : "  # " + by) << '\n' << std::flush;
  process_.log(fmt::format("{}: {} in macrostep {}", by, to_string(order), i));
}

bool OperatorCommandServer::stop_accepted() const {
  return stop_ || std::ranges::find(waiting_, OperatorOrder::stop) != waiting_.end();
}

bool OperatorCommandServer::waits_for_a_person() const {
  const bool start = state_ == TaskState::waiting_for_start && !image_.started;
  const bool resume = state_ == TaskState::paused && image_.paused;
  const bool trigger = state_ == TaskState::running && waits_for_trigger_ && trigger_due_;
  return (start || resume || trigger) && waiting_.empty() && script_.empty() && !stop_ && !emergency_;
}

std::string OperatorCommandServer::needed() const {
  if (state_ == TaskState::waiting_for_start && !image_.started) return "start";
  if (state_ == TaskState::paused && image_.paused) return "resume";
  if (state_ == TaskState::running && waits_for_trigger_)
    return fmt::format("trigger {}", image_.trigger + 1);
  return "";
}

std::optional<std::int64_t> OperatorCommandServer::next_in_script() const {
  if (script_.empty()) return std::nullopt;
  return script_.front().i;
}

void OperatorCommandServer::set_behaviour(int m) {
  if (m == m_) return;
  if (std::erase(waiting_, OperatorOrder::trigger) > 0)
    process_.log(fmt::format("operator: the trigger came when behaviour {} had ended, it is not obeyed", m_));
  m_ = m;
  waits_for_trigger_ = trigger_due_ = false;
}

void OperatorCommandServer::set_state(TaskState state, bool waits_for_trigger) {
  if (state != state_) settle(false, {}, "");
  state_ = state;
  waits_for_trigger_ = waits_for_trigger;
}

}  // namespace mrroc::mp
