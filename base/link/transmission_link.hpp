// Typed links between agents: the transmission images of a pair, x_cT_jj' = y_cT_j'j (MS (9), (10), (14)). Any two agents
// may have one, whatever they are: two arms, an arm and an agent without an effector, the coordinator and anybody.
//
// A task gives the value a message of its own in base/msg, the conversions to_message() beside the value and from_message()
// in the namespace of the messages, and there is_proper(), which says whether the numbers of a message that came from the
// network can be used:
//
//   link::OutgoingLink<Plan> plan(process, link::link_channel("map", "rex", "plan"));  // in the process of `map`
//   link::IncomingLink<Plan> plan(process, link::link_channel("map", "rex", "plan"));  // in the process of `rex`
//
// The shell of the agent sends and receives them with its own links, once per macrostep (OtherLinks).
#pragma once
#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/link/process.hpp"
#include "base/link/receive_deadline.hpp"

namespace mrroc::link {

/// The message of a value V.
template <class V>
using MessageOf = decltype(to_message(std::declval<const V&>()));

/// A value that agents may send to each other.
template <class V>
concept Transmitted = std::is_trivially_copyable_v<V> && std::default_initializable<V> &&
    FixedMessage<MessageOf<V>> && requires(const MessageOf<V>& m) {
  { from_message(m) } -> std::same_as<V>;
  { is_proper(m) }
  noexcept->std::same_as<bool>;
};

/// @param from, to  keys of agents  @param what  of what is said, a word
/// @return channel of the link T_jj' from one agent to another, without the session: FROM.TO.WHAT
[[nodiscard]] inline std::string link_channel(const std::string& from, const std::string& to,
                                              const std::string& what) {
  return from + "." + to + "." + what;
}

/// An outgoing link, whatever its values are.
class Outgoing {
 public:
  virtual ~Outgoing() = default;
  /// Sends the present value for that macrostep: once in every macrostep (rule R1).
  virtual void send(std::int64_t stamp) = 0;
  /// Says that nothing more will come: the agent's program is over, and nobody waits for it any more.
  virtual void end() = 0;
};

/// An incoming link, whatever its values are.
class Incoming {
 public:
  virtual ~Incoming() = default;
  /// @return where its messages come in
  [[nodiscard]] virtual const InboxBase& inbox() const = 0;
  /// @return whether the message of macrostep i has come (rule R1), or the other agent's program has ended before
  [[nodiscard]] virtual bool here(std::int64_t i) const = 0;
  /// Takes what is to be seen in macrostep i, see IncomingLink. @throws FaultError malformed_message
  virtual void receive(std::int64_t i) = 0;
};

/// y_cT_jj': one value per macrostep from this agent to another one. What is not set anew is said again.
template <Transmitted V>
class OutgoingLink final : public Outgoing {
 public:
  /// @param process  must outlive the link  @param channel  without the session
  OutgoingLink(Process& process, const std::string& channel) : out_(process.outbox<MessageOf<V>>(channel)) {}

  /// @param value  is sent from now on; the first one is V{}
  void set(const V& value) { value_ = value; }
  void send(std::int64_t stamp) override {
    if (!ended_) out_->publish(to_message(value_), stamp);
  }
  void end() override {
    send(kEndOfLink);
    ended_ = true;
  }

 private:
  std::unique_ptr<Outbox<MessageOf<V>>> out_;
  V value_{};
  bool ended_{};
};

/// x_cT_j'j: what an agent has received on a link. Trivially copyable.
template <class V>
struct Received {
  V value{};  ///< the newest one that has been seen; V{} before the first
  bool
      late{};  ///< it is not of this macrostep: the sender has ended, or the clock is the wall's, or loss or delay injected
};

/// x_cT_j'j: one value per macrostep from another agent.
///
/// In lock-step the message stamped i is waited for and seen in macrostep i. With the wall clock nobody waits: the newest
/// message that has come and is not stamped above i is taken, and is late when it is an older one. Injected loss and delay
/// (rule R5) hide messages from the receiver, as a function of seed and stamp. A value never goes back to an older one.
template <Transmitted V>
class IncomingLink final : public Incoming {
 public:
  /// @param process  must outlive the link  @param channel  without the session
  /// @param injection  of loss and delay
  IncomingLink(Process& process, const std::string& channel, const Injection& injection = {})
      : in_(process.inbox<MessageOf<V>>(channel)), injection_(injection) {}

  /// @return what was seen in the last receive()
  [[nodiscard]] const Received<V>& image() const { return image_; }

  [[nodiscard]] const InboxBase& inbox() const override { return *in_; }
  [[nodiscard]] bool here(std::int64_t i) const override {
    return in_->at(i) != nullptr || in_->ended_before(i);
  }
  void receive(std::int64_t i) override {
    const MessageOf<V>* const m = in_->visible(i, injection_);
    if (m && m->header.stamp > stamp_) {
      if (!is_proper(*m))
        throw FaultError(FaultCode::malformed_message, in_->channel() + ": a number is not proper");
      stamp_ = m->header.stamp;
      image_.value = from_message(*m);
    }
    image_.late = stamp_ < i;
  }

 private:
  std::unique_ptr<Inbox<MessageOf<V>>> in_;
  Injection injection_;
  Received<V> image_;
  std::int64_t stamp_{};  // of the value, 0: none has come
};

/// Links of an agent beside those that its shell has by itself. All of them must outlive the shell's links.
struct OtherLinks {
  /// Inboxes that the agent reads itself, such as those of cameras with a clock of their own; they are waited for.
  Sources sources{};
  /// In lock-step: whether what macrostep i needs of them has come (rule R7). Empty: it needs nothing.
  /// @param step  of the effector driver's reading in x_ce; of a coordinator 0
  std::function<bool(std::int64_t i, std::int64_t step)> here{};
  std::vector<Incoming*>
      incoming{};  ///< waited for and received in every macrostep, also while the agent is paused
  std::vector<Outgoing*> outgoing{};  ///< sent in every macrostep, from the first one on

  /// @return all sources, those of the typed links among them
  [[nodiscard]] Sources all_sources() const {
    Sources all = sources;
    for (const Incoming* const link : incoming) all.push_back(&link->inbox());
    return all;
  }
  /// @return whether everything of macrostep i has come
  [[nodiscard]] bool all_here(std::int64_t i, std::int64_t step) const {
    for (const Incoming* const link : incoming)
      if (!link->here(i)) return false;
    return !here || here(i, step);
  }
  /// Calls send() of the typed links. @param stamp  macrostep
  void send(std::int64_t stamp) const {
    for (Outgoing* const link : outgoing) link->send(stamp);
  }
  /// Calls end() of the typed links.
  void end() const {
    for (Outgoing* const link : outgoing) link->end();
  }
  /// Calls receive() of the typed links. @throws FaultError malformed_message
  void receive(std::int64_t i) const {
    for (Incoming* const link : incoming) link->receive(i);
  }
};

}  // namespace mrroc::link
