#include "tasks/manual/command_server.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/fault.hpp"
#include "base/link/text.hpp"
#include "base/with_remedy.hpp"

namespace mrroc::manual {
namespace {

constexpr std::size_t kRemembered = 64;

/// In place of the number of an order that no arm has got, because a stop came in the same macrostep. Below all numbers.
constexpr std::int64_t kCalledOff = -1;

void set(manual_answer_t& answer, InstructionState state) { answer.state = static_cast<std::int32_t>(state); }
/// Several reasons have to fit into one answer.
/// @param alone  no other arm was told the same
std::string why(const std::string& arm, const Fault& fault, bool alone) {
  if (fault.code == FaultCode::not_synchronised)
    return fmt::format("{0} does not know its position; `ui_cli manual home {0}` finds it", arm);
  return alone ? fmt::format("{}: {}", arm, describe(fault))
               : fmt::format("{}: {}: {}", arm, to_string(fault.code), what_happened(fault));
}

bool is(const manual_answer_t& answer, InstructionState state) {
  return answer.state == static_cast<std::int32_t>(state);
}

}  // namespace

CommandServer::CommandServer(link::Process& process, std::vector<ArmInfo> arms, InstructionScript script,
                             const std::filesystem::path& record)
    : process_(process),
      arms_(std::move(arms)),
      words_in_(process.bus(), process.route(kWords), process.context().session_id),
      answer_out_(process.bus(), process.route(kAnswer), process.context().session_id),
      script_(script.begin(), script.end()) {
  if (record.empty()) return;
  record_.open(record);
  record_ << "# Instructions of the operator: macrostep and words. Replay with --words.\n";
}

Hands CommandServer::take(std::int64_t i, const std::vector<std::int64_t>& given,
                          const std::vector<Report>& reports, bool paused) {
  Hands hands{.orders = std::vector<std::optional<ManualOrder>>(arms_.size())};
  for (; !script_.empty() && script_.front().i <= i; script_.pop_front()) {
    Asked asked;
    const std::string words = script_.front().instruction;
    if (const auto refusal = obey(i, words, given, reports, false, hands, asked))
      process_.log(fmt::format("script: '{}' in macrostep {} is refused, {}", words, i, refusal->reason),
                   FaultCode::bad_script);
  }
  answer_terminals(i, given, reports, paused, hands);
  return hands;
}

std::optional<CommandServer::Refusal> CommandServer::obey(std::int64_t i, const std::string& words,
                                                          const std::vector<std::int64_t>& given,
                                                          const std::vector<Report>& reports, bool paused,
                                                          Hands& hands, Asked& asked) {
  Instructions wanted;
  try {
    wanted = understand(words, arms_);
  } catch (const FaultError& e) {
    return Refusal{with_remedy(e.what(), e.remedy()), InstructionState::not_understood};
  }
  for (std::size_t k = 0; k < wanted.arms.size(); ++k) {
    const std::size_t arm = wanted.arms[k];
    const bool stop = wanted.orders[k].kind == Kind::stop;
    if (paused && !stop) return Refusal{"paused; resume first, with `ui_cli resume`"};
    const bool busy = reports[arm].event != given[arm] || hands.orders[arm];
    if (busy && !stop)
      return Refusal{fmt::format("{0} is busy; `stop {0}` ends what it does", arms_[arm].key)};
    if (reports[arm].driver_state == DriverState::faulted && wanted.orders[k].kind != Kind::reset && !stop)
      return Refusal{fmt::format("{0} waits for `reset {0}` after a fault", arms_[arm].key)};
  }
  for (std::size_t k = 0; k < wanted.arms.size(); ++k) {
    auto& order = hands.orders[wanted.arms[k]];
    if (order && order->kind != Kind::stop) call_off(wanted.arms[k], given[wanted.arms[k]] + 1);
    order = wanted.orders[k];
    asked.stop = order->kind == Kind::stop;
    asked.orders.emplace_back(wanted.arms[k], given[wanted.arms[k]] + 1);
  }
  hands.end = hands.end || wanted.end;
  if (record_.is_open()) record_ << i << ' ' << words << '\n' << std::flush;
  process_.log(fmt::format("operator: {} in macrostep {}", words, i));
  return std::nullopt;
}

void CommandServer::call_off(std::size_t arm, std::int64_t number) {
  for (Asked& a : asked_) std::ranges::replace(a.orders, std::pair{arm, number}, std::pair{arm, kCalledOff});
}

void CommandServer::answer_terminals(std::int64_t i, const std::vector<std::int64_t>& given,
                                     const std::vector<Report>& reports, bool paused, Hands& hands) {
  for (Asked& a : asked_)
    if (is(a.answer, InstructionState::taken)) conclude(a, reports);
  while (const auto m = words_in_.take()) {
    auto known = std::ranges::find(asked_, m->id, &Asked::id);
    if (known == asked_.end()) {
      Asked asked{.id = m->id, .orders = {}, .stop = {}, .answer = {}};
      const auto refusal = obey(i, link::get_text(m->text), given, reports, paused, hands, asked);
      asked.answer.id = m->id;
      // In a pause only stops come that far. The arm stands already, and does not go on when the pause ends.
      set(asked.answer, refusal                          ? refusal->state
                        : asked.orders.empty() || paused ? InstructionState::done
                                                         : InstructionState::taken);
      link::put_text(asked.answer.text, refusal ? refusal->reason : std::string("accepted"));
      asked_.push_back(std::move(asked));
      if (asked_.size() > kRemembered) asked_.pop_front();
      known = std::prev(asked_.end());
    }
    answer_out_.publish(known->answer, i);
  }
}

void CommandServer::conclude(Asked& asked, const std::vector<Report>& reports) {
  std::string failures;
  for (const auto& [arm, number] : asked.orders) {
    const Report& r = reports[arm];
    if (r.event < number) return;
    if (r.event > number)
      failures += fmt::format("{}{}: called off", failures.empty() ? "" : "; ", arms_[arm].key);
    else if (r.fault && !asked.stop)
      failures += (failures.empty() ? "" : "; ") + why(arms_[arm].key, r.fault, asked.orders.size() == 1);
  }
  set(asked.answer, failures.empty() ? InstructionState::done : InstructionState::failed);
  link::put_text(asked.answer.text, failures.empty() ? std::string("done") : failures);
  answer_out_.publish(asked.answer, 0);
}

}  // namespace mrroc::manual
