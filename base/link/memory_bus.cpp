#include "base/link/memory_bus.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <vector>

namespace mrroc::link {
namespace {

struct Packet {
  std::string channel;
  std::vector<std::uint8_t> bytes;
  bool to_all;  // for the sinks of subscribe_all, otherwise for those of the channel
};

/// Queue of one end: filled by the others' threads, emptied by its own.
struct Mailbox {
  std::mutex mutex;
  std::condition_variable arrived;
  std::deque<Packet> packets;

  void put(const std::string& channel, std::span<const std::uint8_t> bytes, bool to_all) {
    {
      const std::lock_guard lock(mutex);
      packets.push_back({channel, {bytes.begin(), bytes.end()}, to_all});
    }
    arrived.notify_one();
  }
};

}  // namespace

struct MemoryHub::Shared {
  struct Listener {
    Mailbox* mailbox;
    std::string prefix;  // of subscribe_all, empty: an exact channel
  };
  std::mutex mutex;
  std::map<std::string, std::vector<Mailbox*>> exact;
  std::vector<Listener> all;
};

namespace {

class MemoryBus final : public Bus {
 public:
  explicit MemoryBus(MemoryHub::Shared& shared) : shared_(shared) {}

  ~MemoryBus() override {
    const std::lock_guard lock(shared_.mutex);
    for (auto& [channel, mailboxes] : shared_.exact) std::erase(mailboxes, &mailbox_);
    std::erase_if(shared_.all, [this](const auto& l) { return l.mailbox == &mailbox_; });
  }
  MemoryBus(const MemoryBus&) = delete;
  MemoryBus& operator=(const MemoryBus&) = delete;

  void publish(const Route& route, std::span<const std::uint8_t> bytes) override {
    const std::lock_guard lock(shared_.mutex);
    if (const auto it = shared_.exact.find(route.channel); it != shared_.exact.end())
      for (Mailbox* m : it->second) m->put(route.channel, bytes, false);
    if (route.group != Group::agents) return;
    for (const auto& l : shared_.all)
      if (route.channel.starts_with(l.prefix)) l.mailbox->put(route.channel, bytes, true);
  }

  void subscribe(const Route& route, Sink& sink) override {
    const std::lock_guard lock(shared_.mutex);
    auto& mailboxes = shared_.exact[route.channel];
    if (std::ranges::find(mailboxes, &mailbox_) == mailboxes.end()) mailboxes.push_back(&mailbox_);
    sinks_[route.channel].push_back(&sink);
  }

  void subscribe_all(const std::string& prefix, Sink& sink) override {
    const std::lock_guard lock(shared_.mutex);
    shared_.all.push_back({&mailbox_, prefix});
    all_.push_back(&sink);
  }

  bool wait(std::chrono::milliseconds timeout) override {
    std::deque<Packet> packets;
    {
      std::unique_lock lock(mailbox_.mutex);
      if (!mailbox_.arrived.wait_for(lock, timeout, [this] { return !mailbox_.packets.empty(); }))
        return false;
      packets.swap(mailbox_.packets);
    }
    for (const Packet& p : packets) deliver(p);
    return true;
  }

 private:
  void deliver(const Packet& p) {
    if (p.to_all) {
      for (Sink* s : all_) s->receive(p.channel, p.bytes);
    } else if (const auto it = sinks_.find(p.channel); it != sinks_.end()) {
      for (Sink* s : it->second) s->receive(p.channel, p.bytes);
    }
  }

  MemoryHub::Shared& shared_;
  Mailbox mailbox_;
  std::map<std::string, std::vector<Sink*>> sinks_;
  std::vector<Sink*> all_;
};

}  // namespace

MemoryHub::MemoryHub() : shared_(std::make_unique<Shared>()) {}
MemoryHub::~MemoryHub() = default;
std::unique_ptr<Bus> MemoryHub::open() { return std::make_unique<MemoryBus>(*shared_); }

}  // namespace mrroc::link
