// Channels of one message type: sequence numbers, stamps, counters, resending.
#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "base/hash.hpp"
#include "base/link/bus.hpp"
#include "base/link/decode.hpp"
#include "base/link/injection.hpp"

namespace mrroc::link {

/// What a receiver has seen.
struct Counters {
  std::int64_t received{};   ///< taken
  std::int64_t repeated{};   ///< came again, ignored
  std::int64_t malformed{};  ///< not exactly one message of the type, dropped
  std::int64_t foreign{};    ///< of another session, dropped
  std::int64_t gaps{};       ///< numbers that have not come, or not yet
};

/// What is known of any inbox, whatever its messages are.
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

/// Receives one channel and keeps the last kDepth messages by stamp.
template <FixedMessage M>
class Inbox final : public InboxBase {
 public:
  /// Messages that are kept.
  static constexpr std::int64_t kDepth = 16;

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
  /// @return the message with the highest number, or null
  [[nodiscard]] const M* newest() const noexcept { return newest_ ? at(newest_stamp_) : nullptr; }
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

  void receive(std::string_view, std::span<const std::uint8_t> bytes) noexcept override {
    const auto m = decode<M>(bytes);
    if (!m || m->header.number <= 0) {
      ++counters_.malformed;
      return;
    }
    if (m->header.session != session_) {
      ++counters_.foreign;
      return;
    }
    Slot& s = slot(m->header.stamp);
    if (s.number >= m->header.number) {
      ++counters_.repeated;
      return;
    }
    s = {m->header.number, *m};
    ++counters_.received;
    if (m->header.number > newest_) {
      counters_.gaps += m->header.number - newest_ - 1;
      newest_ = m->header.number;
      newest_stamp_ = m->header.stamp;
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
  std::int64_t newest_{};
  std::int64_t newest_stamp_{};
};

/// Receives one channel and keeps every message until it is taken; for lines of text and for channels with
/// several senders, whose numbers say nothing.
template <FixedMessage M>
class Queue final : public Sink {
 public:
  /// @param bus  must outlive the queue  @param session  messages of any other are dropped
  Queue(Bus& bus, const Route& route, std::int64_t session) : session_(session) {
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

  void receive(std::string_view, std::span<const std::uint8_t> bytes) noexcept override {
    const auto m = decode<M>(bytes);
    if (m && m->header.session == session_ && messages_.size() < kMost) messages_.push_back(*m);
  }

 private:
  static constexpr std::size_t kMost = 10000;
  std::int64_t session_;
  std::deque<M> messages_;
};

/// What a process can do with any of its outboxes.
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
template <FixedMessage M>
class Outbox final : public OutboxBase {
 public:
  static constexpr std::size_t kKept = 4;  ///< messages

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
