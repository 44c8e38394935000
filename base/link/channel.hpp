// Channels of one message type: sequence numbers, stamps, counters, resending.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "base/hash.hpp"
#include "base/link/bus.hpp"
#include "base/link/decode.hpp"
#include "base/link/injection.hpp"
#include "base/link/replay_window.hpp"
#include "base/link/senders.hpp"

namespace mrroc::link {

/// Stamp of a message that says that no more will come on its channel.
inline constexpr std::int64_t kEndOfLink = kLargestStamp;

/// Counters of a receiver.
struct Counters {
  std::int64_t received{};  ///< taken
  std::int64_t repeated{};  ///< came again, ignored
  std::int64_t
      malformed{};  ///< not exactly one message of the type, or its numbers are beyond all bounds; dropped
  std::int64_t foreign{};  ///< of another session, dropped
  std::int64_t gaps{};     ///< numbers that have not come, or not yet
};

/// Interface of every inbox, independent of its type of message.
class InboxBase : public Sink {
 public:
  /// @return with the session's name
  [[nodiscard]] const std::string& channel() const noexcept { return channel_; }
  /// @return what has come so far
  [[nodiscard]] const Counters& counters() const noexcept { return counters_; }

 protected:
  explicit InboxBase(std::string channel) : channel_(std::move(channel)) {}
  Counters counters_;

 private:
  std::string channel_;
};

/// Messages that an inbox keeps.
inline constexpr std::int64_t kInboxDepth = 16;
/// Messages that an outbox can send again.
inline constexpr std::size_t kOutboxKept = 4;

/// Receives one channel and keeps the last kDepth messages by stamp.
template <FixedMessage M, std::int64_t depth = kInboxDepth>
class Inbox final : public InboxBase {
 public:
  /// Messages that are kept.
  static constexpr std::int64_t kDepth = depth;

  /// @param session messages of any other are dropped
  Inbox(Bus& bus, const Route& route, std::int64_t session) : InboxBase(route.channel), session_(session) {
    bus.subscribe(route, *this);
  }
  Inbox(const Inbox&) = delete;
  Inbox& operator=(const Inbox&) = delete;

  /// @return the message for that stamp, or null when it has not come
  [[nodiscard]] const M* at(std::int64_t stamp) const noexcept {
    const Slot& s = slot(stamp);
    return s.number != 0 && s.message.header.stamp == stamp ? &s.message : nullptr;
  }
  /// @return the message with the highest number, but for the one that ends the link; null when there is none
  [[nodiscard]] const M* newest() const noexcept { return last_ ? at(last_stamp_) : nullptr; }
  /// @return the message with the lowest stamp of those from that stamp on, or null: what comes next for a
  ///         reader that may have missed some
  [[nodiscard]] const M* next(std::int64_t stamp) const noexcept {
    const M* first = nullptr;
    for (const Slot& s : slots_)
      if (s.number != 0 && s.message.header.stamp >= stamp &&
          (!first || s.message.header.stamp < first->header.stamp))
        first = &s.message;
    return first;
  }

  /// @return the message with the highest stamp, not above that one, that has come and that injection neither loses nor
  ///         delays beyond it; null when there is none
  [[nodiscard]] const M* visible(std::int64_t stamp, const Injection& injection) const noexcept {
    const M* last = nullptr;
    for (const Slot& s : slots_) {
      const std::int64_t sent = s.message.header.stamp;
      if (s.number == 0 || sent > stamp || (last && sent <= last->header.stamp)) continue;
      const Injection::Fate fate = injection.fate(sent);
      if (fate.copies > 0 && sent + fate.delay <= stamp) last = &s.message;
    }
    return last;
  }

  /// @return whether the sender has ended, and its last message was for a stamp below that one. Unknown, and so false,
  ///         until that last message has come: by the wall clock stamps are skipped, so numbers do not tell it
  [[nodiscard]] bool ended_before(std::int64_t stamp) const noexcept {
    return end_ != 0 && last_ >= end_ - 1 && stamp > last_stamp_;
  }

  /// Calls see(message) for every message that the receiver is to see at that stamp after injection: once
  /// with the message of the stamp when nothing is injected.
  template <class See>
  void due(std::int64_t stamp, const Injection& injection, See see) const {
    for (std::int64_t s = stamp - Injection::kMaxDelay; s <= stamp; ++s) {
      const M* const m = at(s);
      if (!m) continue;
      const Injection::Fate fate = injection.fate(s);
      if (s + fate.delay == stamp)
        for (int copy = 0; copy < fate.copies; ++copy) see(*m);
    }
  }

  [[nodiscard]] std::size_t largest() const noexcept override {
    return static_cast<std::size_t>(encoded_size<M>());
  }
  void receive(std::string_view, std::span<const std::uint8_t> bytes) noexcept override {
    const auto m = decode<M>(bytes);
    if (m && m->header.session != session_) {
      ++counters_.foreign;
      return;
    }
    if (!m || !plausible(m->header, newest_)) {
      ++counters_.malformed;
      return;
    }
    const bool end = m->header.stamp == kEndOfLink;
    std::int64_t& taken = end ? end_ : slot(m->header.stamp).number;
    if (taken >= m->header.number) {
      ++counters_.repeated;
      return;
    }
    taken = m->header.number;
    if (!end) slot(m->header.stamp).message = *m;
    if (!end && m->header.number > last_) {
      last_ = m->header.number;
      last_stamp_ = m->header.stamp;
    }
    ++counters_.received;
    if (m->header.number > newest_) {
      counters_.gaps += m->header.number - newest_ - 1;
      newest_ = m->header.number;
    } else {
      --counters_.gaps;
    }
  }

 private:
  struct Slot {
    std::int64_t number{};  // 0: empty
    M message{};
  };
  static std::size_t index(std::int64_t stamp) noexcept {
    return static_cast<std::size_t>(static_cast<std::uint64_t>(stamp) % kDepth);
  }
  Slot& slot(std::int64_t stamp) noexcept { return slots_[index(stamp)]; }
  const Slot& slot(std::int64_t stamp) const noexcept { return slots_[index(stamp)]; }

  std::int64_t session_;
  std::array<Slot, kDepth> slots_{};
  std::int64_t newest_{};      // highest number, also that of the message that ends the link
  std::int64_t last_{};        // highest number but that one
  std::int64_t last_stamp_{};  // of the message with that number
  std::int64_t end_{};         // number of the message that ends the link, 0: there is none yet
};

/// Receives one channel and keeps every message until it is taken; for lines of text and for channels with
/// several senders, whose numbers say nothing. Of one sender a message that comes again is dropped.
template <FixedMessage M>
class Queue final : public Sink {
 public:
  /// @param bus  must outlive the queue  @param session  messages of any other are dropped
  Queue(Bus& bus, const Route& route, std::int64_t session)
      : session_(session), numbered_(!has_several_senders(route.channel)) {
    bus.subscribe(route, *this);
  }
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;

  /// @return the oldest message that has not been taken, or nothing
  std::optional<M> take() {
    if (messages_.empty()) return std::nullopt;
    const M m = messages_.front();
    messages_.pop_front();
    return m;
  }

  [[nodiscard]] std::size_t largest() const noexcept override {
    return static_cast<std::size_t>(encoded_size<M>());
  }
  void receive(std::string_view, std::span<const std::uint8_t> bytes) noexcept override {
    const auto m = decode<M>(bytes);
    if (!m || m->header.session != session_ || messages_.size() >= kMost) return;
    try {
      messages_.push_back(*m);
    } catch (const std::bad_alloc&) {
      return;  // before its number counts as seen: a repetition makes up for it
    }
    if (numbered_ && !is_next(m->header)) messages_.pop_back();
  }

 private:
  static constexpr std::size_t kMost = 10000;

  bool is_next(const header_t& header) noexcept {
    if (!plausible(header, newest_) || !come_.take(static_cast<std::uint64_t>(header.number))) return false;
    newest_ = std::max(newest_, header.number);
    return true;
  }

  std::int64_t session_;
  bool numbered_;  // by one sender
  std::int64_t newest_{};
  ReplayWindow come_;
  std::deque<M> messages_;
};

/// Interface of every outbox of a process.
class OutboxBase {
 public:
  virtual ~OutboxBase() = default;
  /// Publishes the last kept messages again, as they were: repairs real losses.
  virtual void repeat() = 0;
  /// @return with the session's name
  [[nodiscard]] virtual const std::string& channel() const = 0;
  /// @return fingerprint of everything published, without sessions
  [[nodiscard]] virtual std::uint64_t hash() const = 0;
  /// @return number of messages published
  [[nodiscard]] virtual std::int64_t count() const = 0;
};

/// Publishes one channel: numbers its messages, keeps the last kKept for resending and fingerprints them.
template <FixedMessage M, std::size_t Kept = kOutboxKept>
class Outbox final : public OutboxBase {
 public:
  static constexpr std::size_t kKept = Kept;  ///< messages

  /// @param bus  must outlive the outbox  @param session  goes into every header
  Outbox(Bus& bus, Route route, std::int64_t session)
      : bus_(bus), route_(std::move(route)), session_(session) {
    const auto size = static_cast<std::size_t>(encoded_size<M>());
    for (auto& k : kept_) k.reserve(size);
  }

  /// Fills in the header and publishes.
  /// @param stamp macrostep or step that the message is for
  void publish(M message, std::int64_t stamp) {
    message.header = {session_, ++number_, stamp};
    auto& bytes = kept_[static_cast<std::size_t>(number_) % kKept];
    bytes.resize(static_cast<std::size_t>(encoded_size<M>()));
    message.encode(bytes.data(), 0, encoded_size<M>());
    hash_.add(std::span(bytes).subspan(kAfterSession));
    bus_.publish(route_, bytes);
  }

  void repeat() override {
    for (std::int64_t n = std::max<std::int64_t>(1, number_ - static_cast<std::int64_t>(kKept) + 1);
         n <= number_; ++n)
      bus_.publish(route_, kept_[static_cast<std::size_t>(n) % kKept]);
  }
  [[nodiscard]] const std::string& channel() const override { return route_.channel; }
  [[nodiscard]] std::uint64_t hash() const override { return hash_.value(); }
  [[nodiscard]] std::int64_t count() const override { return number_; }

 private:
  static constexpr std::size_t kAfterSession = 16;  // LCM's fingerprint and header_t::session

  Bus& bus_;
  Route route_;
  std::int64_t session_;
  std::int64_t number_{};
  std::array<std::vector<std::uint8_t>, kKept> kept_;
  Hash hash_;
};

}  // namespace mrroc::link
