#include "base/link/lcm_bus.hpp"

#include <fmt/core.h>
#include <lcm/lcm.h>
#include <poll.h>

#include <array>
#include <memory>
#include <regex>
#include <vector>

namespace mrroc::link {
namespace {

struct LcmDeleter {
  void operator()(lcm_t* lcm) const { lcm_destroy(lcm); }
};
using LcmHandle = std::unique_ptr<lcm_t, LcmDeleter>;

void deliver(const lcm_recv_buf_t* buffer, const char* channel, void* sink) {
  static_cast<Sink*>(sink)->receive(channel,
                                    {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
}

/// The address as the library takes it: bursts of a macrostep must fit into the sockets.
std::string lcm_url(const LcmAddress& a) { return a.url() + "&recv_buf_size=4194304"; }

std::string escaped(const std::string& text) {
  static const std::regex special(R"([.^$|()\[\]{}*+?\\])");
  return std::regex_replace(text, special, R"(\$&)");
}

class LcmBus final : public Bus {
 public:
  explicit LcmBus(const LcmAddress& address) {
    for (int g = 0; g < kGroups; ++g) {
      LcmAddress a = address;
      a.port += g;
      lcm_[static_cast<std::size_t>(g)].reset(lcm_create(lcm_url(a).c_str()));
      if (!lcm_[static_cast<std::size_t>(g)])
        throw NoMulticast(fmt::format("no multicast route for {}", a.url()));
    }
  }

  void publish(const Route& route, std::span<const std::uint8_t> bytes) override {
    lcm_publish(lcm(route.group), route.channel.c_str(), bytes.data(), static_cast<unsigned>(bytes.size()));
  }

  void subscribe(const Route& route, Sink& sink) override {
    listen(route.group, escaped(route.channel), sink);
  }

  void subscribe_all(const std::string& prefix, Sink& sink) override {
    listen(Group::agents, escaped(prefix) + ".*", sink);
  }

  bool wait(std::chrono::milliseconds timeout) override {
    if (::poll(files_.data(), files_.size(), static_cast<int>(timeout.count())) <= 0) return false;
    bool came = false;
    for (std::size_t k = 0; k < files_.size(); ++k) {
      lcm_t* const from = listening_[k];
      if (!from || !(files_[k].revents & POLLIN)) continue;
      came = true;
      while (lcm_handle_timeout(from, 0) > 0) {
      }
    }
    return came;
  }

  void wake_on(int file) override {
    listening_.push_back(nullptr);
    files_.push_back({file, POLLIN, 0});
  }

 private:
  lcm_t* lcm(Group g) { return lcm_[static_cast<std::size_t>(g)].get(); }

  void listen(Group group, const std::string& pattern, Sink& sink) {
    lcm_t* const l = lcm(group);
    lcm_subscription_t* const s = lcm_subscribe(l, pattern.c_str(), deliver, &sink);
    if (!s) throw NoMulticast(fmt::format("cannot listen to {}", pattern));
    lcm_subscription_set_queue_capacity(s, 10000);  // a full queue would drop the newest message
    for (const lcm_t* known : listening_)
      if (known == l) return;
    listening_.push_back(l);
    files_.push_back({lcm_get_fileno(l), POLLIN, 0});
  }

  std::array<LcmHandle, kGroups> lcm_;
  std::vector<lcm_t*> listening_;  // of each file; null: it only wakes
  std::vector<pollfd> files_;
};

}  // namespace

LcmAddress LcmAddress::parse(const std::string& url) {
  // 224.0.0.0 to 239.255.255.255 are the addresses for multicast.
  static const std::regex form(
      R"(udpm://(2(?:2[4-9]|3\d)(?:\.(?:25[0-5]|2[0-4]\d|1?\d{1,2})){3}):(\d{1,5})(?:\?ttl=(\d{1,3}))?)");
  std::smatch part;
  if (!std::regex_match(url, part, form))
    throw std::invalid_argument(
        fmt::format("'{}' is not of the form udpm://HOST:PORT?ttl=N with a HOST for multicast, 224.0.0.0 to "
                    "239.255.255.255",
                    url));
  LcmAddress a{part[1], std::stoi(part[2]), part[3].matched ? std::stoi(part[3]) : 0};
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
