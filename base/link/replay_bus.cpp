#include "base/link/replay_bus.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/link/process.hpp"
#include "base/link/senders.hpp"
#include "base/msg/message_type.hpp"

namespace mrroc::link {
namespace {

/// Which part of f' a channel carries: its last word.
struct Part {
  std::string_view channel;
  std::string_view function;
};
constexpr std::array kParts{Part{"command", "f_ce"}, Part{"report", "f_cT"}, Part{"order", "f_cT"},
                            Part{"servo", "f_cc"}, Part{"setting", "f_cV"}};

std::string function_of(std::string_view channel, std::string_view field) {
  const std::string_view last = channel.substr(channel.rfind('.') + 1);
  // A task's own orders and reports are called cube_order and the like.
  const auto part = std::ranges::find_if(kParts, [&](const Part& p) {
    return last.ends_with(p.channel) &&
           (last == p.channel || last[last.size() - p.channel.size() - 1] == '_');
  });
  if (part == kParts.end() || channel == "hand.order") return {};
  // Another behaviour than in the log: the one before ended earlier or later.
  return field == "m" ? "f_tau" : std::string(part->function);
}

constexpr std::string_view kSupervisor = "supervisor";

}  // namespace

std::optional<LogDifference> difference(std::string_view channel, std::span<const std::uint8_t> logged,
                                        std::span<const std::uint8_t> recomputed) {
  if (std::ranges::equal(logged, recomputed)) return std::nullopt;
  const RawHeader header = header_of(logged);
  LogDifference d{.channel = std::string(channel), .number = header.number, .stamp = header.stamp};
  const MessageType* const type = type_of(logged);
  if (!type || type_of(recomputed) != type) {
    d.logged = type ? type->name : fmt::format("{} bytes that are no message", logged.size());
    const MessageType* const other = type_of(recomputed);
    d.recomputed = other ? other->name : fmt::format("{} bytes that are no message", recomputed.size());
    return d;
  }
  for (const Field& f : type->fields) {
    if (std::ranges::equal(logged.subspan(f.offset, f.size), recomputed.subspan(f.offset, f.size))) continue;
    d.field = f.name;
    d.logged = value_in(logged, f);
    d.recomputed = value_in(recomputed, f);
    d.function = function_of(channel, f.name);
    break;
  }
  return d;
}

ReplayBus::ReplayBus(const LogReader& log, const std::set<std::string>& left_out)
    : log_(log), left_out_(left_out) {
  for (const LoggedMessage& m : log.messages())
    channels_[m.channel].logged.try_emplace(header_of(m.bytes).number, &m);
}

std::string ReplayBus::bare(const std::string& channel) const {
  return channel.substr(std::min(channel.size(), log_.session().size() + 1));
}

void ReplayBus::subscribe(const Route& route, Sink& sink) {
  const std::string channel = bare(route.channel);
  if (!left_out_.contains(channel)) sinks_[channel].push_back(&sink);
}

void ReplayBus::publish(const Route& route, std::span<const std::uint8_t> bytes) {
  if (!judge_.compares || !judge_.compares(route.channel)) return;
  Channel& channel = channels_[bare(route.channel)];
  const std::int64_t number = header_of(bytes).number;
  if (number <= channel.sent) return;  // a repetition
  channel.sent = number;
  note(route, bytes, channel);
}

void ReplayBus::note(const Route& route, std::span<const std::uint8_t> bytes, const Channel& channel) {
  const auto it = channel.logged.find(header_of(bytes).number);
  if (it == channel.logged.end()) return;  // beyond the end of the log, or a gap in it
  ++compared_;
  auto found = difference(bare(route.channel), it->second->bytes, bytes);
  if (!found) return;
  ++differences_;
  if (first_) return;
  first_ = std::move(found);
  behaviour_open_ = true;
}

bool ReplayBus::kept_back(const LoggedMessage& m) const {
  if (m.channel != kSupervisor) return false;
  const auto said = decode<supervisor_t>(m.bytes);
  return said && said->phase >= static_cast<int>(Phase::stopping) && said->as_of == 0;
}

bool ReplayBus::deliver(const LoggedMessage& m) {
  const auto it = sinks_.find(m.channel);
  if (it == sinks_.end()) return false;
  for (Sink* const sink : it->second) sink->receive(log_.session() + "." + m.channel, m.bytes);
  return true;
}

bool ReplayBus::wait(std::chrono::milliseconds timeout) {
  if (behaviour_open_ && judge_.behaviour) first_->behaviour = judge_.behaviour();
  behaviour_open_ = false;
  if (timeout.count() == 0) return false;
  while (next_ < log_.messages().size()) {
    const LoggedMessage& m = log_.messages()[next_++];
    if (kept_back(m))
      kept_back_.push_back(&m);
    else if (deliver(m))
      return true;
  }
  while (next_kept_back_ < kept_back_.size())
    if (deliver(*kept_back_[next_kept_back_++])) return true;
  throw LogEnded{};
}

std::map<std::string, std::vector<std::int64_t>> ReplayBus::not_sent() const {
  std::map<std::string, std::vector<std::int64_t>> left;
  if (!judge_.compares) return left;
  for (const auto& [name, channel] : channels_) {
    if (!judge_.compares(log_.session() + "." + name)) continue;
    for (auto it = channel.logged.upper_bound(channel.sent); it != channel.logged.end(); ++it)
      left[name].push_back(it->first);
  }
  return left;
}

std::string ReplayBus::missing() const {
  for (const auto& [name, sinks] : sinks_) {
    const auto it = channels_.find(name);
    if (it == channels_.end()) continue;
    if (!it->second.logged.empty() && !type_of(it->second.logged.begin()->second->bytes))
      return fmt::format("{} as this version of the framework has it", name);
    if (has_several_senders(log_.session() + "." + name)) continue;
    std::int64_t expected = 1;
    for (const auto& [number, message] : it->second.logged) {
      if (number != expected) return fmt::format("{}, number {}", name, expected);
      ++expected;
    }
  }
  return {};
}

}  // namespace mrroc::link
