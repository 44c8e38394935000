#include "ui_cli/log/replay_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "base/fault.hpp"
#include "base/joined.hpp"
#include "base/link/channel.hpp"
#include "base/link/process.hpp"
#include "base/link/text.hpp"
#include "base/msg/convert.hpp"

namespace mrroc::ui {
namespace {

using link::LoggedMessage;

/// @return what the process sent in the run, from what it told at its end
std::set<std::string> channels_of(const RunRecord& run, const std::string& process) {
  std::set<std::string> channels;
  for (const LoggedMessage& m : run.log().messages()) {
    if (m.channel != process + ".status") continue;
    const auto status = link::decode<process_status_t>(m.bytes);
    if (!status) continue;
    const auto count = std::min<std::size_t>(static_cast<std::size_t>(std::max(0, status->n_hashes)),
                                             std::size(status->hash));
    for (std::size_t k = 0; k < count; ++k) {
      const std::string channel = link::get_text(status->hash[k].channel);
      if (channel.size() > 1) channels.insert(channel.substr(1));  // behind the dot
    }
  }
  if (!channels.empty()) return channels;
  throw FaultError(FaultCode::bad_log,
                   fmt::format("the run does not tell what {} sent: it did not come to its end", process),
                   "take a run that was done");
}

}  // namespace

struct ReplayCheck::ReplayedNode final : link::Sink {
  ReplayedNode(link::Bus& bus, const std::string& session, const std::string& name, std::int64_t session_id)
      : status(bus, {link::Group::agents, session + "." + name + ".status"}, session_id), of(session_id) {
    verdict.process = name;
  }
  void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override {
    try {
      const link::RawHeader header = link::header_of(bytes);
      auto& said = heard[std::string(channel.substr(channel.find('.') + 1))];
      if (header.session != of || bytes.size() != said.size) return;
      if (header.number > said.passed) said.messages.try_emplace(header.number, bytes.begin(), bytes.end());
    } catch (const std::exception&) {  // no memory: it is told as not said
    }
  }

  struct Said {
    std::size_t size{};     // of a message, in the log [bytes]
    std::int64_t passed{};  // number of the last one that was compared
    std::map<std::int64_t, std::vector<std::uint8_t>> messages;
  };
  link::Inbox<process_status_t> status;
  std::map<std::string, Said> heard;  // by channel without the session
  std::int64_t of;                    // this session
  link::LogVerdict verdict;
  bool silent{};
  std::string ended;  // how; empty: it runs
};

ReplayCheck::ReplayCheck(link::Bus& bus, const RunRecord& run, const std::string& session,
                         const std::vector<std::string>& processes) {
  if (run.clock() == "wall")
    throw FaultError(FaultCode::bad_usage,
                     "the run went by the wall clock: a log does not tell what had arrived when a process "
                     "decided, so there is nothing to compare");
  const std::int64_t id = run.log().session_id();
  for (const std::string& name : processes) {
    if (std::ranges::find(run.processes(), name, &LoggedProcess::name) == run.processes().end())
      throw FaultError(FaultCode::bad_usage,
                       fmt::format("the run has no process '{}'; it has {}", name,
                                   joined(run.processes(), ", ", &LoggedProcess::name)));
    auto& w = *nodes_.emplace_back(std::make_unique<ReplayedNode>(bus, session, name, id));
    for (const std::string& channel : channels_of(run, name)) {
      const auto first = std::ranges::find(run.log().messages(), channel, &LoggedMessage::channel);
      w.heard[channel].size = first == run.log().messages().end() ? 0 : first->bytes.size();
      channels_.insert(channel);
      bus.subscribe({link::Group::agents, session + "." + channel}, w);
    }
    channels_.insert({name + ".status", name + ".console"});
  }
}

ReplayCheck::~ReplayCheck() = default;

bool ReplayCheck::ready() const {
  return std::ranges::all_of(nodes_, [](const auto& w) {
    const process_status_t* const s = w->status.newest();
    if (s && s->state == static_cast<int>(link::ProcessState::faulted))
      throw FaultError(from_message(s->fault));
    return s && s->state >= static_cast<int>(link::ProcessState::ready);
  });
}

ReplayCheck::ReplayedNode* ReplayCheck::sender(const std::string& channel) {
  const auto found = std::ranges::find_if(nodes_, [&](const auto& w) { return w->heard.contains(channel); });
  return found == nodes_.end() ? nullptr : found->get();
}

bool ReplayCheck::passed(const LoggedMessage& m) {
  ReplayedNode* const w = sender(m.channel);
  if (!w || w->silent) return true;
  ReplayedNode::Said& said = w->heard[m.channel];
  const std::int64_t number = link::header_of(m.bytes).number;
  const auto now = said.messages.find(number);
  if (now == said.messages.end()) {
    if (w->ended.empty()) return false;
    give_up(m);
    return true;
  }
  ++w->verdict.compared;
  if (const auto d = link::difference(m.channel, m.bytes, now->second)) {
    ++w->verdict.differences;
    if (!w->verdict.first) w->verdict.first = d;
  }
  said.passed = number;
  said.messages.erase(said.messages.begin(), std::next(now));
  return true;
}

void ReplayCheck::ended(const std::string& process, const std::string& how) {
  for (const auto& w : nodes_)
    if (w->verdict.process == process) w->ended = how;
}

void ReplayCheck::give_up(const LoggedMessage& m) {
  ReplayedNode* const w = sender(m.channel);
  if (!w) return;
  const link::RawHeader header = link::header_of(m.bytes);
  w->silent = true;
  ++w->verdict.differences;
  w->verdict.incomplete =
      w->ended.empty() ? fmt::format("it said nothing more on {}", m.channel)
                       : fmt::format("it ended with {} and said nothing more on {}", w->ended, m.channel);
  if (!w->verdict.first)
    w->verdict.first = link::LogDifference{.channel = m.channel,
                                           .number = header.number,
                                           .stamp = header.stamp,
                                           .logged = "a message",
                                           .recomputed = "nothing"};
}

void ReplayCheck::cut_short() {
  for (const auto& w : nodes_)
    if (w->verdict.incomplete.empty()) w->verdict.incomplete = "the replay was stopped";
}

std::vector<link::LogVerdict> ReplayCheck::verdicts() const {
  std::vector<link::LogVerdict> all;
  for (const auto& w : nodes_) all.push_back(w->verdict);
  return all;
}

}  // namespace mrroc::ui
