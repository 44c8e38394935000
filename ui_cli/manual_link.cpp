#include "ui_cli/manual_link.hpp"

#include <fmt/core.h>

#include "base/fault.hpp"
#include "base/link/decode.hpp"
#include "base/link/text.hpp"
#include "base/msg/convert.hpp"

namespace mrroc::ui {
namespace {

/// @param session  of the task; 0: of the first message that comes
/// @return whether the message is of this session
bool is_of(std::int64_t& session, const header_t& header) {
  if (session == 0) session = header.session;
  return header.session == session;
}

}  // namespace

/// Keeps the newest answer to one instruction; a later state is never followed by an earlier one.
struct ManualLink::Answers final : link::Sink {
  explicit Answers(std::int64_t& of) : session(of) {}
  void receive(std::string_view, std::span<const std::uint8_t> bytes) noexcept override {
    const auto m = link::decode<manual_answer_t>(bytes);
    if (!m || !is_of(session, m->header) || m->id != id || m->state < 0 ||
        m->state > static_cast<int>(InstructionState::not_understood))
      return;
    ++count;
    if (!newest || m->state >= newest->state) newest = *m;
  }
  std::int64_t& session;
  std::int64_t id{};
  std::int64_t count{};
  std::optional<manual_answer_t> newest;
};

/// Keeps the newest reply of a driver.
struct ManualLink::Readings final : link::Sink {
  explicit Readings(std::int64_t& of) : session(of) {}
  void receive(std::string_view, std::span<const std::uint8_t> bytes) noexcept override {
    const auto m = link::decode<effector_reply_t>(bytes);
    if (m && is_of(session, m->header)) newest = *m;
  }
  std::int64_t& session;
  std::optional<effector_reply_t> newest;
};

ManualLink::ManualLink(link::Bus& bus, const link::SessionInfo& session, const std::vector<std::string>& arms,
                       Timeouts timeouts)
    : bus_(bus), session_(session), timeouts_(timeouts), answers_(std::make_unique<Answers>(session_.id)) {
  bus_.subscribe({link::Group::agents, session_.name + ".manual.answer"}, *answers_);
  for (const std::string& arm : arms) {
    auto& readings = readings_[arm] = std::make_unique<Readings>(session_.id);
    bus_.subscribe({link::Group::agents, fmt::format("{}.{}.reply", session_.name, arm)}, *readings);
  }
}

ManualLink::~ManualLink() = default;

std::string too_long(std::size_t characters) {
  return fmt::format("an instruction has at most {} characters, and this one {}", kLongestInstruction,
                     characters);
}

void ManualLink::begin(const std::string& words, Clock::time_point now) {
  if (words.size() > kLongestInstruction)
    throw FaultError(FaultCode::bad_usage, too_long(words.size()), kShorter);
  words_ = words;
  id_ = link::random_id();
  count_ = 0;
  told_.reset();
  heard_ = now;
  sent_ = {};
  answers_->id = id_;
  answers_->count = 0;
  answers_->newest.reset();
}

std::optional<ManualAnswer> ManualLink::poll(Clock::time_point now) {
  if (id_ == 0) return std::nullopt;
  if (answers_->count != count_) {
    count_ = answers_->count;
    heard_ = now;
    const auto state = static_cast<InstructionState>(answers_->newest->state);
    if (state != InstructionState::taken) id_ = 0;
    if (told_ != state) {
      told_ = state;
      return ManualAnswer{words_, state, link::get_text(answers_->newest->text)};
    }
    if (id_ == 0) return std::nullopt;
  }
  if (now - heard_ > timeouts_.give_up) {
    id_ = 0;
    throw FaultError(FaultCode::peer_silent,
                     fmt::format("session {} says nothing: no answer to an instruction", session_.name),
                     "instructions are for the task `manual`: look with `ui_cli list`");
  }
  if (sent_ == Clock::time_point{} || now - sent_ > timeouts_.repeat) {
    sent_ = now;
    manual_words_t m{};
    m.header = {session_.id, id_, 0};
    m.id = id_;
    link::put_text(m.text, words_);
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(link::encoded_size<manual_words_t>()));
    m.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    bus_.publish({link::Group::agents, session_.name + ".manual.words"}, bytes);
  }
  return std::nullopt;
}

std::optional<EffectorReply> ManualLink::reading(const std::string& arm) const {
  const auto it = readings_.find(arm);
  if (it == readings_.end() || !it->second->newest) return std::nullopt;
  return from_message(*it->second->newest);
}

}  // namespace mrroc::ui
