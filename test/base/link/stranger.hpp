// Somebody on this host who has no key: he hears everything and sends whatever bytes he likes.
#pragma once
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/link/lcm_bus.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::link::test {

class Stranger {
 public:
  explicit Stranger(const LcmAddress& to) : file_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    to_.sin_family = AF_INET;
    to_.sin_port = htons(static_cast<std::uint16_t>(to.port));
    ::inet_pton(AF_INET, to.host.c_str(), &to_.sin_addr);
    const std::uint8_t ttl = 0;
    ::setsockopt(file_, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  }
  ~Stranger() { ::close(file_); }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;
  void send(const Bytes& datagram) const {
    ::sendto(file_, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&to_), sizeof to_);
  }

 private:
  int file_;
  sockaddr_in to_{};
};

/// @return everything that was sent to that address since the socket was made
inline std::vector<Bytes> heard(MulticastSocket& socket) {
  std::vector<Bytes> all;
  while (const std::size_t n = socket.take())
    for (std::size_t k = 0; k < n; ++k)
      all.emplace_back(socket.datagram(k).begin(), socket.datagram(k).end());
  return all;
}

}  // namespace mrroc::link::test
