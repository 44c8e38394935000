#include "base/link/lcm_bus.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <lcm/lcm.h>
#include <netinet/in.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "base/link/lcm_packet.hpp"

namespace mrroc::link {
namespace {

struct LcmDeleter {
  void operator()(lcm_t* lcm) const { lcm_destroy(lcm); }
};
using LcmHandle = std::unique_ptr<lcm_t, LcmDeleter>;

bool is_multicast(const std::string& host) {
  in_addr address{};
  return ::inet_pton(AF_INET, host.c_str(), &address) == 1 && IN_MULTICAST(ntohl(address.s_addr));
}

/// @return whether the text is a number without a sign, and nothing else
bool read_number(std::string_view text, int& number) {
  const auto [end, error] = std::from_chars(text.begin(), text.end(), number);
  return error == std::errc() && end == text.end() && text.front() != '-';
}

/// Sends as LCM does, so that its tools can listen; receives by itself, as LCM's reader trusts what a stranger says of the
/// sizes of fragments.
class LcmBus final : public Bus {
 public:
  explicit LcmBus(const LcmAddress& address) : address_(address) {
    for (int g = 0; g < kGroups; ++g) {
      LcmAddress a = address;
      a.port += g;
      sending_[static_cast<std::size_t>(g)].reset(lcm_create(a.url().c_str()));
      if (!sending_[static_cast<std::size_t>(g)])
        throw NoMulticast(fmt::format("no multicast route for {}", a.url()));
    }
  }

  void publish(const Route& route, std::span<const std::uint8_t> bytes) override {
    if (bytes.size() > kLargestMessage)
      throw std::length_error(fmt::format("{} has {} bytes", route.channel, bytes.size()));
    lcm_publish(sending_[index(route.group)].get(), route.channel.c_str(), bytes.data(),
                static_cast<unsigned>(bytes.size()));
  }

  void subscribe(const Route& route, Sink& sink) override {
    listen(route.group).exact[route.channel].push_back(&sink);
  }

  void subscribe_all(const std::string& prefix, Sink& sink) override {
    listen(Group::agents).all.emplace_back(prefix, &sink);
  }

  bool wait(std::chrono::milliseconds timeout) override {
    if (::poll(files_.data(), files_.size(), static_cast<int>(timeout.count())) <= 0) return false;
    bool came = false;
    for (const auto& group : listening_)
      if (group && (files_[group->file].revents & POLLIN)) {
        came = true;
        group->receive();
      }
    return came;
  }

  void wake_on(int file) override { files_.push_back({file, POLLIN, 0}); }

 private:
  static std::size_t index(Group g) { return static_cast<std::size_t>(g); }

  /// Who listens in one group.
  struct Listening {
    Listening(const std::string& host, int port) : socket(host, port) {}

    /// Hands on what has come. In a flood it ends all the same, so that the process gets to its other work.
    void receive() {
      constexpr std::size_t kMostAtOnce = 4096;
      for (std::size_t taken = 0, n = 1; n > 0 && taken < kMostAtOnce; taken += n) {
        n = socket.take();
        for (std::size_t k = 0; k < n; ++k)
          if (const auto packet = read_packet(socket.datagram(k))) deliver(*packet);
      }
    }
    void deliver(const LcmPacket& p) {
      if (const auto it = exact.find(p.channel); it != exact.end())
        for (Sink* const s : it->second) s->receive(p.channel, p.bytes);
      for (const auto& [prefix, sink] : all)
        if (p.channel.starts_with(prefix)) sink->receive(p.channel, p.bytes);
    }

    MulticastSocket socket;
    std::size_t file{};  // in files_
    std::map<std::string, std::vector<Sink*>, std::less<>> exact;
    std::vector<std::pair<std::string, Sink*>> all;
  };

  Listening& listen(Group g) {
    auto& group = listening_[index(g)];
    if (!group) {
      group = std::make_unique<Listening>(address_.host, address_.port + static_cast<int>(g));
      group->file = files_.size();
      files_.push_back({group->socket.file(), POLLIN, 0});
    }
    return *group;
  }

  LcmAddress address_;
  std::array<LcmHandle, kGroups> sending_;
  std::array<std::unique_ptr<Listening>, kGroups> listening_;
  std::vector<pollfd> files_;
};

}  // namespace

LcmAddress LcmAddress::parse(const std::string& url) {
  constexpr std::string_view kBegin = "udpm://", kTtl = "?ttl=";
  LcmAddress a;
  const std::size_t colon = url.find(':', kBegin.size()), ttl = std::min(url.find(kTtl), url.size());
  const bool whole = url.starts_with(kBegin) && colon < ttl;
  if (whole) a.host = url.substr(kBegin.size(), colon - kBegin.size());
  if (!whole || !is_multicast(a.host) ||
      !read_number(std::string_view(url).substr(0, ttl).substr(colon + 1), a.port) ||
      (ttl < url.size() && !read_number(std::string_view(url).substr(ttl + kTtl.size()), a.ttl)))
    throw std::invalid_argument(
        fmt::format("'{}' is not of the form udpm://HOST:PORT?ttl=N with a HOST for multicast, 224.0.0.0 to "
                    "239.255.255.255",
                    url));
  if (a.port < 1024 || a.port + kGroups > 65535)
    throw std::invalid_argument(fmt::format("port {} is outside 1024..{}", a.port, 65535 - kGroups));
  if (a.ttl > 255) throw std::invalid_argument(fmt::format("ttl {} is outside 0..255", a.ttl));
  return a;
}

std::string LcmAddress::url() const { return fmt::format("udpm://{}:{}?ttl={}", host, port, ttl); }

std::unique_ptr<Bus> open_lcm(const LcmAddress& address) { return std::make_unique<LcmBus>(address); }

bool multicast_works(const LcmAddress& address) {
  struct Flag : Sink {
    bool seen = false;
    void receive(std::string_view, std::span<const std::uint8_t>) noexcept override { seen = true; }
  } flag;
  try {
    LcmBus bus(address);
    const Route probe{Group::agents, fmt::format("probe.{}", address.port)};
    bus.subscribe(probe, flag);
    const std::array<std::uint8_t, 8> bytes{};
    for (int tries = 0; tries < 10 && !flag.seen; ++tries) {
      bus.publish(probe, bytes);
      bus.wait(std::chrono::milliseconds(50));
    }
  } catch (const NoMulticast&) {
  }
  return flag.seen;
}

}  // namespace mrroc::link
