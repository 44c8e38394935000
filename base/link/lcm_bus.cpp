#include "base/link/lcm_bus.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <vector>

#include "base/link/authentication.hpp"
#include "base/link/lcm_packet.hpp"
#include "base/msg/message_type.hpp"

namespace mrroc::link {
namespace {

bool is_multicast(const std::string& host) {
  in_addr address{};
  return ::inet_pton(AF_INET, host.c_str(), &address) == 1 && IN_MULTICAST(ntohl(address.s_addr));
}

/// @return whether the text is a number without a sign, and nothing else
bool read_number(std::string_view text, int& number) {
  const auto [end, error] = std::from_chars(text.begin(), text.end(), number);
  return error == std::errc() && end == text.end() && text.front() != '-';
}

/// A process that sends in one group. It counts as another one in each group: only messages of one group keep their order.
class Talking {
 public:
  explicit Talking(const LcmAddress& a) : sender_(a.host, a.port, a.ttl) {
    std::random_device device;
    origin_.sender = std::uniform_int_distribution<std::uint64_t>{}(device);
  }
  void publish(const std::string& channel, std::span<const std::uint8_t> bytes, const TagKey& key) {
    ++origin_.counter;
    write_packet(datagram_, static_cast<std::uint32_t>(origin_.counter), channel, bytes);
    sign(datagram_, origin_, key);
    sender_.send(datagram_);
  }

 private:
  MulticastSender sender_;
  Origin origin_;
  std::vector<std::uint8_t> datagram_;
};

/// Listeners of one group.
class Listening {
 public:
  Listening(const LcmAddress& a, std::size_t place) : file(place), socket_(a.host, a.port) {}

  const std::size_t file;  ///< place among those that are waited for

  [[nodiscard]] int descriptor() const { return socket_.file(); }
  void add(const std::string& channel, Sink& sink) {
    exact_[channel].push_back(&sink);
    allow(sink);
  }
  void add_all(const std::string& prefix, Sink& sink) {
    const bool first = all_.empty();
    all_.emplace_back(prefix, &sink);
    allow(sink);
    if (first) not_told_ = socket_.dropped();
  }

  /// Hands on what has come. In a flood it ends all the same, so that the process gets to its other work.
  /// @return whether a message of the session was among it
  bool receive(const TagKey& key) {
    constexpr std::size_t kMostAtOnce = 4096;
    bool came = false;
    for (std::size_t taken = 0, n = 1; n > 0 && taken < kMostAtOnce; taken += n) {
      n = socket_.take();
      for (std::size_t k = 0; k < n; ++k) came = take(socket_.datagram(k), key) || came;
    }
    return came;
  }

  /// The kernel tells one count, without reasons, and another channel is no reproach: the count says something only where
  /// all channels are heard.
  [[nodiscard]] Dropped dropped() const {
    Dropped d = dropped_;
    if (!all_.empty()) d.kernel = socket_.dropped() - not_told_;
    return d;
  }

 private:
  /// The cheapest check comes first.
  bool take(std::span<const std::uint8_t> datagram, const TagKey& key) {
    const auto packet = read_packet(datagram);
    if (!packet || packet->bytes.size() < kTrailer) return ++dropped_.malformed, false;
    if (!wanted(packet->channel)) return false;
    const auto origin = authenticate(datagram, key);
    if (!origin) return ++dropped_.forged, false;
    switch (senders_.take(*origin)) {
      case SenderTable::Verdict::fresh:
        deliver(packet->channel, packet->bytes.first(packet->bytes.size() - kTrailer));
        return true;
      case SenderTable::Verdict::replayed:
        ++dropped_.replayed;
        break;
      case SenderTable::Verdict::one_too_many:
        ++dropped_.crowded;
        break;
    }
    return false;
  }
  [[nodiscard]] bool wanted(std::string_view channel) const {
    return exact_.contains(channel) ||
           std::ranges::any_of(all_, [&](const auto& each) { return channel.starts_with(each.first); });
  }
  void deliver(std::string_view channel, std::span<const std::uint8_t> bytes) const {
    if (const auto it = exact_.find(channel); it != exact_.end())
      for (Sink* const s : it->second) s->receive(channel, bytes);
    for (const auto& [prefix, sink] : all_)
      if (channel.starts_with(prefix)) sink->receive(channel, bytes);
  }
  void allow(const Sink& sink) {
    // Messages between other processes of the session are no error, so they must not be counted as dropped.
    static const std::size_t known = std::ranges::max(message_types(), {}, &MessageType::size).size;
    largest_ = std::max({largest_, std::min(sink.largest(), kLargestMessage), known});
    std::vector<std::string> channels;
    if (all_.empty())
      for (const auto& [channel, sinks] : exact_) channels.push_back(channel);
    socket_.take_only(kPacketHeader + kLongestChannel + 1 + largest_ + kTrailer, channels);
  }

  MulticastSocket socket_;
  std::map<std::string, std::vector<Sink*>, std::less<>> exact_;
  std::vector<std::pair<std::string, Sink*>> all_;
  std::size_t largest_{};  // message that anybody may send or take [bytes]
  SenderTable senders_;
  Dropped dropped_;
  std::int64_t not_told_{};  // dropped by the kernel before all channels were heard
};

/// Datagrams as LCM makes them, so that its tools can listen; received by itself, as LCM's reader trusts what a stranger says
/// of the sizes of fragments.
class LcmBus final : public Bus {
 public:
  LcmBus(const LcmAddress& address, const Key& key) : address_(address), key_(key) {
    for (int g = 0; g < kGroups; ++g) talking_[static_cast<std::size_t>(g)].emplace(at(g));
  }

  void publish(const Route& route, std::span<const std::uint8_t> bytes) override {
    if (bytes.size() > kLargestMessage)
      throw std::length_error(fmt::format("{} has {} bytes", route.channel, bytes.size()));
    if (route.channel.empty() || route.channel.size() > kLongestChannel) return;  // nobody could hear it
    talking_[index(route.group)]->publish(route.channel, bytes, key_);
  }

  void subscribe(const Route& route, Sink& sink) override { listen(route.group).add(route.channel, sink); }

  void subscribe_all(const std::string& prefix, Sink& sink) override {
    listen(Group::agents).add_all(prefix, sink);
  }

  bool wait(std::chrono::milliseconds timeout) override {
    using Clock = std::chrono::steady_clock;
    const auto deadline = Clock::now() + timeout;
    for (auto left = timeout;; left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now())) {
      if (left.count() < 0) return false;
      const int ready = ::poll(files_.data(), files_.size(), static_cast<int>(left.count()));
      if (ready <= 0) return false;
      int heard = 0;
      bool came = false;
      for (const auto& group : listening_)
        if (group && files_[group->file].revents != 0) {
          ++heard;
          came = group->receive(key_) || came;
        }
      if (came) return true;
      if (heard < ready || left.count() == 0) return false;  // another file, or no time left
    }
  }

  void wake_on(int file) override { files_.push_back({file, POLLIN, 0}); }

  [[nodiscard]] Dropped dropped() const override {
    Dropped sum;
    for (const auto& group : listening_) {
      if (!group) continue;
      const Dropped d = group->dropped();
      sum.malformed += d.malformed;
      sum.forged += d.forged;
      sum.replayed += d.replayed;
      sum.crowded += d.crowded;
      sum.kernel += d.kernel;
    }
    return sum;
  }

 private:
  static std::size_t index(Group g) { return static_cast<std::size_t>(g); }
  [[nodiscard]] LcmAddress at(int group) const {
    LcmAddress a = address_;
    a.port += group;
    return a;
  }

  Listening& listen(Group g) {
    auto& group = listening_[index(g)];
    if (!group) {
      group = std::make_unique<Listening>(at(static_cast<int>(g)), files_.size());
      files_.push_back({group->descriptor(), POLLIN, 0});
    }
    return *group;
  }

  LcmAddress address_;
  TagKey key_;
  std::array<std::optional<Talking>, kGroups> talking_;
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

std::unique_ptr<Bus> open_lcm(const LcmAddress& address, const Key& key) {
  return std::make_unique<LcmBus>(address, key);
}

bool multicast_works(const LcmAddress& address) {
  struct Flag : Sink {
    bool seen = false;
    void receive(std::string_view, std::span<const std::uint8_t>) noexcept override { seen = true; }
  } flag;
  try {
    LcmBus bus(address, Key::random());
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
