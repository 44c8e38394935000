#include "ui_cli/client.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <new>
#include <vector>

#include "base/effector_command.hpp"
#include "base/fault.hpp"
#include "base/link/decode.hpp"
#include "base/link/text.hpp"
#include "mrroc/operator_order_t.hpp"

namespace mrroc::ui {
namespace {

/// @return whether the arm stands, and will as long as nobody commands it
bool stands(DriverState s) {
  return s == DriverState::not_synchronised || s == DriverState::ready || s == DriverState::holding ||
         s == DriverState::faulted;
}

bool stops(OperatorOrder order) {
  return order == OperatorOrder::stop || order == OperatorOrder::pause ||
         order == OperatorOrder::emergency_stop;
}

}  // namespace

void Client::StatusSink::receive(std::string_view, std::span<const std::uint8_t> bytes) noexcept {
  const auto m = link::decode<task_status_t>(bytes);
  if (!m || (session != 0 && m->header.session != session)) return;
  if (count > 0 && m->header.number <= newest.header.number) return;
  session = m->header.session;
  newest = *m;
  ++count;
}

void Client::AnswerSink::receive(std::string_view, std::span<const std::uint8_t> bytes) noexcept {
  if (wanted == 0) return;
  const auto m = link::decode<operator_answer_t>(bytes);
  if (m && m->header.session == session && m->id == wanted) found = *m;
}

void Client::DriverSink::receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept {
  constexpr std::string_view kDriver = "edp-", kStatus = ".status";
  if (!channel.ends_with(kStatus) || channel.size() < prefix) return;
  const auto m = link::decode<process_status_t>(bytes);
  if (!m || m->header.session != session || m->effector < 1 || m->effector > static_cast<int>(kDriverStates))
    return;
  channel = channel.substr(prefix, channel.size() - prefix - kStatus.size());
  if (channel.starts_with(kDriver)) channel.remove_prefix(kDriver.size());
  constexpr std::size_t kMost = 16;
  auto it = said.find(channel);
  if (it == said.end()) {
    if (said.size() >= kMost) return;
    try {
      it = said.emplace(channel, Said{}).first;
    } catch (const std::bad_alloc&) {
      return;  // it is heard of when there is memory
    }
  }
  Said& s = it->second;
  s = {s.count + 1, s.step, m->step, m->effector};
}

Client::Client(link::Bus& bus, link::SessionInfo session, Timeouts timeouts)
    : bus_(bus), session_(std::move(session)), timeouts_(timeouts) {
  status_.session = session_.id;
  bus_.subscribe({link::Group::agents, session_.name + ".task_status"}, status_);
  bus_.subscribe({link::Group::agents, session_.name + ".answer"}, answer_);
  drivers_.prefix = session_.name.size() + 1;
  bus_.subscribe_all(session_.name + ".", drivers_);
}

std::optional<Snapshot> Client::status() const {
  if (status_.count == 0) return std::nullopt;
  return snapshot(status_.newest, session_.name);
}

void Client::begin(OperatorOrder order, Clock::time_point now) {
  pending_ = Pending{order, link::random_id(), now, now, status_.count, std::nullopt};
  drivers_.session = status_.session;
  drivers_.said.clear();
  answer_.found.reset();
  answer_.wanted = pending_->id;
}

std::optional<Answer> Client::poll(Clock::time_point now) {
  if (!pending_) return std::nullopt;
  if (answer_.found && answer_.found->pending != 0) {  // it is waited for what a process has to confirm
    pending_->since = now;
    answer_.found.reset();
  }
  if (answer_.found) {
    const Answer answer{pending_->order, answer_.found->accepted != 0, link::get_text(answer_.found->text),
                        fault_code(answer_.found->code).value_or(FaultCode::none)};
    pending_.reset();
    answer_.wanted = 0;
    return answer;
  }
  const bool silent = stops(pending_->order) && status_.count == pending_->news;
  if (now - pending_->since >= timeouts_.give_up ||
      (silent && now - pending_->begun >= timeouts_.drivers && drivers_rest())) {
    const OperatorOrder order = pending_->order;
    pending_.reset();
    answer_.wanted = 0;
    give_up(fmt::format("has not answered {}", to_string(order)), stops(order));
  }
  // In a flood most sendings may be lost: an emergency stop does not wait for long.
  const auto repeat = pending_->order == OperatorOrder::emergency_stop
                          ? std::min(timeouts_.repeat, timeouts_.repeat_emergency)
                          : timeouts_.repeat;
  if (!pending_->sent || now - *pending_->sent >= repeat) {
    pending_->sent = now;
    send();
  }
  return std::nullopt;
}

void Client::send() {
  if (status_.session == 0) return;  // whose order it is, is not known yet
  answer_.session = status_.session;
  operator_order_t m{};
  m.header = {status_.session, ++number_, 0};
  m.id = pending_->id;
  m.order = static_cast<std::int32_t>(pending_->order);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(link::encoded_size<operator_order_t>()));
  m.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  bus_.publish({link::Group::agents, session_.name + ".operator"}, bytes);
}

Answer Client::order(OperatorOrder order) {
  begin(order, Clock::now());
  for (;;) {
    if (auto answer = poll(Clock::now())) return *std::move(answer);
    receive(std::chrono::milliseconds(10));
  }
}

Snapshot Client::await_status() {
  const auto deadline = Clock::now() + timeouts_.give_up;
  while (news() == 0) {
    if (Clock::now() >= deadline) give_up("has told nothing about itself");
    receive(std::chrono::milliseconds(10));
  }
  return *status();
}

bool Client::drivers_rest() const {
  return !drivers_.said.empty() && std::ranges::all_of(drivers_.said, [](const auto& driver) {
    return stands(static_cast<DriverState>(driver.second.effector - 1));
  });
}

std::string Client::describe_drivers() const {
  std::string resting, others;
  for (const auto& [arm, said] : drivers_.said) {
    const auto state = static_cast<DriverState>(said.effector - 1);
    if (stands(state))
      resting += (resting.empty() ? "" : ", ") + arm;
    else
      others += fmt::format("; {} {}", arm,
                            said.count > 1 && said.step == said.step_before
                                ? "stands still, because simulated time does"
                                : fmt::format("moves ({})", to_string(state)));
  }
  return resting.empty() ? others.substr(std::min<std::size_t>(2, others.size()))
                         : resting + " at rest" + others;
}

void Client::give_up(const std::string& waited_for, bool stops) const {
  const double seconds = std::chrono::duration<double>(timeouts_.give_up).count();
  std::string what = fmt::format("the task of session {} {} in {} s", session_.name, waited_for, seconds);
  if (const std::string drivers = stops ? describe_drivers() : ""; !drivers.empty())
    what = drivers_rest() ? fmt::format("stopped: {}; mp does not answer", drivers)
                          : fmt::format("{}; {}", what, drivers);
  if (session_.pid == 0)
    throw FaultError(FaultCode::peer_silent, what,
                     fmt::format("look whether it runs and talks at {}",
                                 session_.address ? session_.address->url() : "this address"));
  const bool rest = stops && drivers_rest();
  throw FaultError(
      FaultCode::peer_silent, what,
      fmt::format("look whether its process {0} hangs (`ps -p {0}`){1}, and at messages.log in {2}",
                  session_.pid,
                  rest ? fmt::format(" or is suspended (`kill -CONT {}` lets it go on)", session_.pid) : "",
                  session_.run_folder.string()));
}

}  // namespace mrroc::ui
