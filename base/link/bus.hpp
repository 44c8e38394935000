// Transports of bytes between processes.
#pragma once
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace mrroc::link {

/// Traffic of one kind shares a group, so that nobody is woken by what does not concern it.
enum class Group : std::uint8_t {
  agents,         ///< once per macrostep and rarer: everything that is logged
  servo_state,    ///< world -> effector drivers, every step
  servo_command,  ///< effector drivers -> world, every step
};
inline constexpr int kGroups = 3;  ///< number of groups

/// Where a message goes.
struct Route {
  Group group{Group::agents};  ///< decides who is woken
  std::string channel;         ///< with the session's name
};

/// Receives the bytes of one channel, or of all.
class Sink {
 public:
  virtual ~Sink() = default;
  /// Must only copy what it needs.
  virtual void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept = 0;
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
  /// Hands what has arrived to its sinks; waits for the first message if there is none.
  /// @return false when nothing came before the time-out
  virtual bool wait(std::chrono::milliseconds timeout) = 0;
  /// Lets wait() return, with false, as soon as this file can be read. Transports that no file can wake do nothing.
  /// @param file  open descriptor, such as that of a terminal's keys; must stay open
  virtual void wake_on([[maybe_unused]] int file) {}
};

}  // namespace mrroc::link
