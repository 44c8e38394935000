#include "ui_cli/message_log.hpp"

#include <algorithm>

#include "base/link/decode.hpp"
#include "base/link/text.hpp"

namespace mrroc::ui {
namespace {

Message to_line(const console_t& m, std::optional<double> time) {
  return {link::get_text(m.process), fault_code(m.code).value_or(FaultCode::internal_error),
          link::get_text(m.text), time};
}

}  // namespace

MessageLog::MessageLog(link::Bus& bus, std::string session) : bus_(bus), session_(std::move(session)) {}

void MessageLog::keep(const Line& line) noexcept { lines_[count_++ % kKept] = line; }

void MessageLog::receive(std::string_view, std::span<const std::uint8_t> bytes) noexcept {
  const auto m = link::decode<console_t>(bytes);
  if (!m || m->header.session != session_id_) return;
  const bool counts = m->header.stamp > 0 && macrostep_s_ > 0;
  keep({*m, counts ? static_cast<double>(m->header.stamp) * macrostep_s_ : sim_time_});
}

void MessageLog::follow(const Snapshot& s) {
  session_id_ = s.session_id;
  sim_time_ = s.sim_time;
  if (s.macrostep > 0 && s.sim_time > 0) macrostep_s_ = s.sim_time / static_cast<double>(s.macrostep);
  for (const ProcessView& p : s.processes)
    if (!p.name.empty() && known_.insert(p.name).second)
      bus_.subscribe({link::Group::agents, session_ + "." + p.name + ".console"}, *this);
  if (s.last_message.empty() || s.last_message == last_message_) return;
  last_message_ = s.last_message;
  const auto heard = newest(kKept);
  const auto same = [&](const Message& m) { return !m.text.empty() && s.last_message.ends_with(m.text); };
  if (std::ranges::any_of(heard, same)) return;
  console_t line{};
  line.code = static_cast<std::int32_t>(s.last_code);
  link::put_text(line.text, s.last_message);
  keep({line, std::nullopt});
}

std::vector<Message> MessageLog::newest(std::size_t count) const {
  const std::size_t n = std::min({count, count_, kKept});
  std::vector<Message> result;
  for (std::size_t k = count_ - n; k < count_; ++k)
    result.push_back(to_line(lines_[k % kKept].said, lines_[k % kKept].time));
  return result;
}

}  // namespace mrroc::ui
