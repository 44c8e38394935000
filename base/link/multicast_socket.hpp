// Sockets that send to a multicast group and receive from it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace mrroc::link {

/// The host lets nobody talk over multicast.
struct NoMulticast : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Hears what is sent to one address and port by multicast, and nothing that is sent to this host alone. Several may
/// hear the same. Used by one thread.
class MulticastSocket {
 public:
  /// @param host  of the multicast group, dotted  @param port  of it  @throws NoMulticast
  MulticastSocket(const std::string& host, int port);
  ~MulticastSocket();
  MulticastSocket(const MulticastSocket&) = delete;
  MulticastSocket& operator=(const MulticastSocket&) = delete;

  /// Lets the kernel drop what is no short packet of LCM, what is larger, and what is on another channel, before it takes
  /// room or wakes anybody, as far as it has room for a filter. Without this, everything is taken.
  /// @param largest   datagram that is wanted [bytes]
  /// @param channels  whole names; none: all
  void take_only(std::size_t largest, const std::vector<std::string>& channels);

  /// @return a descriptor that can be read when something has come
  [[nodiscard]] int file() const noexcept { return file_; }

  /// Takes what has come, as far as there is room; waits for nothing. @return how many datagrams
  std::size_t take() noexcept;
  /// @param k  below what take() has returned  @return the datagram, until the next take()
  [[nodiscard]] std::span<const std::uint8_t> datagram(std::size_t k) const noexcept;
  /// @return datagrams that the kernel has dropped: not wanted, or no room
  [[nodiscard]] std::int64_t dropped() const noexcept;

 private:
  struct Batch;
  int file_;
  std::unique_ptr<Batch> batch_;
};

/// Sends to one address and port by multicast. Used by one thread.
class MulticastSender {
 public:
  /// @param host  of the multicast group, dotted  @param port  of it
  /// @param ttl   how many networks away it is heard, 0: on this host  @throws NoMulticast
  MulticastSender(const std::string& host, int port, int ttl);
  ~MulticastSender();
  MulticastSender(const MulticastSender&) = delete;
  MulticastSender& operator=(const MulticastSender&) = delete;

  /// What the network does not take is lost, like what it loses on its way.
  void send(std::span<const std::uint8_t> datagram) const noexcept;

 private:
  int file_;
};

}  // namespace mrroc::link
