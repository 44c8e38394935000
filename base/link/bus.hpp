// Transports of bytes between processes.
#pragma once
#include <chrono>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace mrroc::link {

/// Traffic of one kind shares a group, so that nobody is woken by what does not concern it.
enum class Group : std::uint8_t {
  agents,         ///< once per macrostep and rarer: everything that is logged
  servo_state,    ///< simulator -> effector drivers, every step
  servo_command,  ///< effector drivers -> simulator, every step
};
inline constexpr int kGroups = 3;  ///< number of groups

/// Destination of a message.
struct Route {
  Group group{Group::agents};  ///< decides which processes are woken
  std::string channel;         ///< with the session's name
};

/// Receives the bytes of one channel, or of all.
class Sink {
 public:
  virtual ~Sink() = default;
  /// Must only copy what it needs. A sink without memory for it treats the message as lost: no exception may leave it.
  virtual void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept = 0;
  /// @return size of the largest message that it takes [bytes]; larger ones need not be handed to it
  [[nodiscard]] virtual std::size_t largest() const noexcept {
    return std::numeric_limits<std::size_t>::max();
  }
};

/// Counts datagrams from the network that were not handed on, because they are no messages of the session.
struct Dropped {
  std::int64_t malformed{};  ///< no packet of one message, on a channel that is heard
  std::int64_t forged{};     ///< not made with the session's key
  std::int64_t replayed{};   ///< had come before, or is too old to tell
  std::int64_t crowded{};    ///< of a sender beyond the most that are remembered
  /// By the kernel in a group of which all channels are heard: no packet, larger than any message, or no room for it. 0
  /// elsewhere, where it is not known.
  std::int64_t kernel{};
  bool operator==(const Dropped&) const = default;
};

/// One process's end of a transport. Used by one thread.
class Bus {
 public:
  virtual ~Bus() = default;
  /// Sends one message. @param bytes  of the whole message; not needed any more afterwards
  virtual void publish(const Route& route, std::span<const std::uint8_t> bytes) = 0;
  /// @param sink  is called by wait(), and must exist as long as that is called
  virtual void subscribe(const Route& route, Sink& sink) = 0;
  /// Gives the sink everything in the group agents whose channel begins with prefix.
  virtual void subscribe_all(const std::string& prefix, Sink& sink) = 0;
  /// Hands what has arrived to its sinks; waits for the first message if there is none. What is dropped wakes nobody.
  /// @return false when no message came before the time-out
  virtual bool wait(std::chrono::milliseconds timeout) = 0;
  /// Lets wait() return, with false, as soon as this file can be read. Transports that no file can wake do nothing.
  /// @param file  open descriptor, such as that of a terminal's keys; must stay open
  virtual void wake_on([[maybe_unused]] int file) {}
  /// @return what was not handed on so far; nothing within one process
  [[nodiscard]] virtual Dropped dropped() const { return {}; }
};

}  // namespace mrroc::link
