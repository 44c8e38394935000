#include "mp/operator_desk.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "base/fault.hpp"
#include "base/link/text.hpp"

namespace mrroc::mp {
namespace {

constexpr std::size_t kRememberedAnswers = 64;

/// Of MP's own orders: nobody waits for their answer.
constexpr std::int64_t kNoAnswer = 0;
constexpr std::chrono::milliseconds kRepeatEmergency{20};

std::optional<OperatorOrder> order_named(std::string_view name) {
  for (const OperatorOrder o : kOperatorOrders)
    if (to_string(o) == name) return o;
  return std::nullopt;
}

}  // namespace

std::vector<ScriptedOrder> load_script(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in)
    throw FaultError(FaultCode::bad_script, fmt::format("cannot read {}", file.string()),
                     "check the name given with --script");
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
  if (in.bad()) throw FaultError(FaultCode::bad_script, fmt::format("cannot read {}", file.string()));
  std::ranges::stable_sort(script, {}, &ScriptedOrder::i);
  return script;
}

OperatorDesk::OperatorDesk(link::Process& process, std::vector<ScriptedOrder> script,
                           const std::filesystem::path& record)
    : process_(process),
      order_in_(process.bus(), process.route("operator"), process.membership().session_id),
      answer_out_(process.bus(), process.route("answer"), process.membership().session_id),
      order_out_(process.bus(), process.route("operator"), process.membership().session_id),
      script_(script.begin(), script.end()) {
  if (!record.empty()) {
    record_.open(record);
    record_ << "# Orders of the operator: macrostep and order. Replay with --script.\n";
  }
}

std::optional<std::string> OperatorDesk::objection(OperatorOrder order) const {
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
      return fmt::format("the task is {} already, its arms rest", to_string(state_));
  }
  return "there is no such order";
}

void OperatorDesk::poll() {
  while (const auto order = order_in_.take()) answer(*order);
}

void OperatorDesk::answer(const operator_order_t& m) {
  if (m.id == kNoAnswer) return;
  const auto known = std::ranges::find(answers_, m.id, &operator_answer_t::id);
  if (known != answers_.end()) {
    answer_out_.publish(*known, 0);
    return;
  }
  const bool exists = m.order >= 0 && m.order < static_cast<int>(kOperatorOrders.size());
  const auto order = static_cast<OperatorOrder>(m.order);
  const auto reason = exists ? objection(order) : "there is no such order";
  operator_answer_t answer{};
  answer.id = m.id;
  answer.accepted = !reason;
  link::put_text(answer.text, reason ? *reason : fmt::format("{} accepted", to_string(order)));
  if (!reason) accept(order);
  answers_.push_back(answer);
  if (answers_.size() > kRememberedAnswers) answers_.pop_front();
  answer_out_.publish(answer, 0);
}

bool OperatorDesk::give(OperatorOrder order) {
  if (objection(order)) return false;
  accept(order);
  return true;
}

void OperatorDesk::accept(OperatorOrder order) {
  if (order == OperatorOrder::emergency_stop)
    obey(order, i_ + 1);  // no macrostep has to come
  else
    waiting_.push_back(order);
}

void OperatorDesk::repeat_emergency() {
  const auto now = link::Process::Clock::now();
  if (!emergency_ || now - repeated_ < kRepeatEmergency) return;
  repeated_ = now;
  order_out_.publish(
      {.header = {}, .id = kNoAnswer, .order = static_cast<std::int32_t>(OperatorOrder::emergency_stop)}, i_);
}

OperatorImage OperatorDesk::take(std::int64_t i) {
  i_ = std::max(i_, i - 1);
  for (; !script_.empty() && script_.front().i <= i; script_.pop_front()) {
    const OperatorOrder order = script_.front().order;
    const auto reason = objection(order);
    if (!reason) accept(order);
    if (reason)
      process_.say(fmt::format("script: {} in macrostep {} is refused, {}", to_string(order), i, *reason),
                   FaultCode::bad_script);
  }
  for (const OperatorOrder order : waiting_) obey(order, i);
  waiting_.clear();
  i_ = i;
  return image_;
}

bool OperatorDesk::take_stop(std::int64_t i) {
  if (std::erase(waiting_, OperatorOrder::stop) == 0) return false;
  obey(OperatorOrder::stop, std::max<std::int64_t>(1, i));
  return true;
}

void OperatorDesk::obey(OperatorOrder order, std::int64_t i) {
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
  if (record_.is_open()) record_ << i << ' ' << to_string(order) << '\n' << std::flush;
  process_.say(fmt::format("operator: {} in macrostep {}", to_string(order), i));
}

bool OperatorDesk::stop_accepted() const {
  return stop_ || std::ranges::find(waiting_, OperatorOrder::stop) != waiting_.end();
}

bool OperatorDesk::waits_for_a_person() const {
  const bool start = state_ == TaskState::waiting_for_start && !image_.started;
  const bool resume = state_ == TaskState::paused && image_.paused;
  const bool trigger = state_ == TaskState::running && waits_for_trigger_ && trigger_due_;
  return (start || resume || trigger) && waiting_.empty() && script_.empty() && !stop_ && !emergency_;
}

void OperatorDesk::set_behaviour(int m) {
  if (m == m_) return;
  if (std::erase(waiting_, OperatorOrder::trigger) > 0)
    process_.say(fmt::format("operator: the trigger came when behaviour {} had ended, it is not obeyed", m_));
  m_ = m;
  waits_for_trigger_ = trigger_due_ = false;
}

void OperatorDesk::set_state(TaskState state, bool waits_for_trigger) {
  state_ = state;
  waits_for_trigger_ = waits_for_trigger;
}

}  // namespace mrroc::mp
