#include "ui_cli/client.hpp"

#include <fmt/core.h>

#include <vector>

#include "base/fault.hpp"
#include "base/link/decode.hpp"
#include "base/link/text.hpp"
#include "mrroc/operator_order_t.hpp"

namespace mrroc::ui {

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

Client::Client(link::Bus& bus, link::SessionInfo session, Patience patience)
    : bus_(bus), session_(std::move(session)), patience_(patience) {
  status_.session = session_.id;
  bus_.subscribe({link::Group::agents, session_.name + ".task_status"}, status_);
  bus_.subscribe({link::Group::agents, session_.name + ".answer"}, answer_);
}

std::optional<Snapshot> Client::status() const {
  if (status_.count == 0) return std::nullopt;
  return snapshot(status_.newest, session_.name);
}

void Client::begin(OperatorOrder order, Clock::time_point now) {
  pending_ = Pending{order, link::random_id(), now, std::nullopt};
  answer_.found.reset();
  answer_.wanted = pending_->id;
}

std::optional<Answer> Client::poll(Clock::time_point now) {
  if (!pending_) return std::nullopt;
  if (answer_.found) {
    const Answer answer{pending_->order, answer_.found->accepted != 0, link::get_text(answer_.found->text)};
    pending_.reset();
    answer_.wanted = 0;
    return answer;
  }
  if (now - pending_->since >= patience_.give_up) {
    const std::string order(to_string(pending_->order));
    pending_.reset();
    answer_.wanted = 0;
    give_up("has not answered " + order);
  }
  if (!pending_->sent || now - *pending_->sent >= patience_.repeat) {
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
  const auto deadline = Clock::now() + patience_.give_up;
  while (news() == 0) {
    if (Clock::now() >= deadline) give_up("has told nothing about itself");
    receive(std::chrono::milliseconds(10));
  }
  return *status();
}

void Client::give_up(const std::string& waited_for) const {
  const std::string what = fmt::format("the task of session {} {} in {} s", session_.name, waited_for,
                                       std::chrono::duration<double>(patience_.give_up).count());
  if (session_.pid == 0)
    throw FaultError(FaultCode::peer_silent, what,
                     fmt::format("look whether it runs and talks at {}",
                                 session_.address ? session_.address->url() : "this address"));
  throw FaultError(FaultCode::peer_silent, what,
                   fmt::format("look whether its process {} hangs (`ps -p {}`), and at messages.log in {}",
                               session_.pid, session_.pid, session_.run_folder.string()));
}

}  // namespace mrroc::ui
