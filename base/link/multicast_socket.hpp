// The receiving end of a multicast group.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

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

  /// @return a descriptor that can be read when something has come
  [[nodiscard]] int file() const noexcept { return file_; }

  /// Takes what has come, as far as there is room; waits for nothing. @return how many datagrams
  std::size_t take() noexcept;
  /// @param k  below what take() has returned  @return the datagram, until the next take()
  [[nodiscard]] std::span<const std::uint8_t> datagram(std::size_t k) const noexcept;

 private:
  struct Batch;
  int file_;
  std::unique_ptr<Batch> batch_;
};

}  // namespace mrroc::link
