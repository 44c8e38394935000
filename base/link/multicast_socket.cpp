#include "base/link/multicast_socket.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "base/link/lcm_packet.hpp"

namespace mrroc::link {
namespace {

constexpr std::size_t kAtOnce = 16;      // datagrams
constexpr int kReceiveBuffer = 4 << 20;  // bursts of a macrostep must fit in [bytes]

int listen_to(const std::string& host, int port) {
  const int file = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const auto must = [&](int done, const char* what) {
    if (file >= 0 && done == 0) return;
    const std::string why = std::strerror(errno);
    if (file >= 0) ::close(file);
    throw NoMulticast(fmt::format("cannot listen to {}:{}: {}: {}", host, port, what, why));
  };
  must(0, "socket");
  const int on = 1;
  must(::setsockopt(file, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on), "SO_REUSEADDR");
  // Beyond what an ordinary user may have it becomes the most that he may.
  if (::setsockopt(file, SOL_SOCKET, SO_RCVBUFFORCE, &kReceiveBuffer, sizeof kReceiveBuffer) != 0)
    must(::setsockopt(file, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer), "SO_RCVBUF");
  // Bound to the group's address the socket hears nothing that is sent to the host itself.
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  must(::inet_pton(AF_INET, host.c_str(), &address.sin_addr) == 1 ? 0 : -1, "address");
  must(::bind(file, reinterpret_cast<const sockaddr*>(&address), sizeof address), "bind");
  const ip_mreq group{address.sin_addr, {htonl(INADDR_ANY)}};
  must(::setsockopt(file, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group), "IP_ADD_MEMBERSHIP");
  return file;
}

}  // namespace

struct MulticastSocket::Batch {
  std::array<std::array<std::uint8_t, kLargestDatagram>, kAtOnce> bytes;
  std::array<iovec, kAtOnce> parts;
  std::array<mmsghdr, kAtOnce> messages;
};

MulticastSocket::MulticastSocket(const std::string& host, int port)
    : file_(listen_to(host, port)), batch_(new Batch) {
  for (std::size_t k = 0; k < kAtOnce; ++k) {
    batch_->parts[k] = {batch_->bytes[k].data(), kLargestDatagram};
    batch_->messages[k] = {};
    batch_->messages[k].msg_hdr.msg_iov = &batch_->parts[k];
    batch_->messages[k].msg_hdr.msg_iovlen = 1;
  }
}

MulticastSocket::~MulticastSocket() { ::close(file_); }

std::size_t MulticastSocket::take() noexcept {
  const int n = ::recvmmsg(file_, batch_->messages.data(), kAtOnce, 0, nullptr);
  return n > 0 ? static_cast<std::size_t>(n) : 0;
}

std::span<const std::uint8_t> MulticastSocket::datagram(std::size_t k) const noexcept {
  return {batch_->bytes[k].data(), batch_->messages[k].msg_len};
}

}  // namespace mrroc::link
