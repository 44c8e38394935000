#include "base/link/multicast_socket.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "base/link/lcm_packet.hpp"
#include "base/link/packet_filter.hpp"

namespace mrroc::link {
namespace {

constexpr std::size_t kAtOnce = 32;      // datagrams
constexpr int kReceiveBuffer = 4 << 20;  // bursts of a macrostep must fit in [bytes]

/// A socket that closes when it cannot be set up.
class Socket {
 public:
  Socket(const std::string& host, int port, std::string_view purpose, int kind)
      : file_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | kind, 0)),
        what_(fmt::format("cannot {} {}:{}", purpose, host, port)) {
    address_.sin_family = AF_INET;
    address_.sin_port = htons(static_cast<std::uint16_t>(port));
    must(file_ >= 0, "socket");
    must(::inet_pton(AF_INET, host.c_str(), &address_.sin_addr) == 1, "address");
  }
  ~Socket() {
    if (file_ >= 0) ::close(file_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  template <class Value>
  bool set(int level, int option, const Value& value) const {
    return ::setsockopt(file_, level, option, &value, sizeof value) == 0;
  }
  [[nodiscard]] const sockaddr* address() const { return reinterpret_cast<const sockaddr*>(&address_); }
  [[nodiscard]] const in_addr& host() const { return address_.sin_addr; }
  [[nodiscard]] int file() const { return file_; }
  int release() { return std::exchange(file_, -1); }
  void must(bool done, std::string_view step) const {
    if (!done) throw NoMulticast(fmt::format("{}: {}: {}", what_, step, std::strerror(errno)));
  }

 private:
  int file_;
  std::string what_;
  sockaddr_in address_{};
};

int listen_to(const std::string& host, int port) {
  Socket s(host, port, "listen to", SOCK_NONBLOCK);
  s.must(s.set(SOL_SOCKET, SO_REUSEADDR, 1), "SO_REUSEADDR");
  // Beyond what an ordinary user may have it becomes the most that he may.
  s.must(s.set(SOL_SOCKET, SO_RCVBUFFORCE, kReceiveBuffer) || s.set(SOL_SOCKET, SO_RCVBUF, kReceiveBuffer),
         "SO_RCVBUF");
  // Bound to the group's address the socket hears nothing that is sent to the host itself.
  s.must(::bind(s.file(), s.address(), sizeof(sockaddr_in)) == 0, "bind");
  s.must(s.set(IPPROTO_IP, IP_ADD_MEMBERSHIP, ip_mreq{s.host(), {htonl(INADDR_ANY)}}), "IP_ADD_MEMBERSHIP");
  return s.release();
}

int send_to(const std::string& host, int port, int ttl) {
  Socket s(host, port, "send to", 0);
  s.must(s.set(IPPROTO_IP, IP_MULTICAST_TTL, ttl), "IP_MULTICAST_TTL");
  s.must(::connect(s.file(), s.address(), sizeof(sockaddr_in)) == 0, "no multicast route");
  return s.release();
}

}  // namespace

struct MulticastSocket::Batch {
  std::array<std::array<std::uint8_t, kLargestDatagram>, kAtOnce> bytes;
  std::array<iovec, kAtOnce> parts;
  std::array<mmsghdr, kAtOnce> messages;
  bool was_all{};  // that had come: the next call need not ask the kernel
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

void MulticastSocket::take_only(std::size_t largest, const std::vector<std::string>& channels) {
  const auto attach = [this](std::vector<sock_filter> program) {
    const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
    return ::setsockopt(file_, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) == 0;
  };
  // The kernel has little room for filters, and would keep the old one, which lacks the newest channel. What it lets
  // pass, meanwhile or without any filter, is dropped later.
  const int none = 0;
  ::setsockopt(file_, SOL_SOCKET, SO_DETACH_FILTER, &none, sizeof none);
  if (!attach(packet_filter(largest, channels))) attach(packet_filter(largest, {}));
}

std::int64_t MulticastSocket::dropped() const noexcept {
  std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
  socklen_t size = sizeof memory;
  return ::getsockopt(file_, SOL_SOCKET, SO_MEMINFO, memory.data(), &size) == 0 ? memory[SK_MEMINFO_DROPS]
                                                                                : 0;
}

std::size_t MulticastSocket::take() noexcept {
  if (std::exchange(batch_->was_all, false)) return 0;
  const int n = ::recvmmsg(file_, batch_->messages.data(), kAtOnce, 0, nullptr);
  batch_->was_all = n > 0 && static_cast<std::size_t>(n) < kAtOnce;
  return n > 0 ? static_cast<std::size_t>(n) : 0;
}

std::span<const std::uint8_t> MulticastSocket::datagram(std::size_t k) const noexcept {
  return {batch_->bytes[k].data(), batch_->messages[k].msg_len};
}

MulticastSender::MulticastSender(const std::string& host, int port, int ttl)
    : file_(send_to(host, port, ttl)) {}

MulticastSender::~MulticastSender() { ::close(file_); }

void MulticastSender::send(std::span<const std::uint8_t> datagram) const noexcept {
  [[maybe_unused]] const auto sent = ::send(file_, datagram.data(), datagram.size(), 0);
}

}  // namespace mrroc::link
