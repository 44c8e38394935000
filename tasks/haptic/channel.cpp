#include "tasks/haptic/channel.hpp"

#include <cmath>

namespace mrroc::haptic {
namespace {

enum Kind : std::uint64_t { loss, jitter };

/// splitmix64: a number that looks random of each number.
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

}  // namespace

double lateness(const ChannelParameters& k, double macrostep) {
  constexpr double kRare = 1e-3;  // share of packets before which more are lost in succession
  const double lost = k.loss > kRare ? std::ceil(std::log(kRare) / std::log(k.loss) - 1e-9) : 0;
  return k.jitter + macrostep * lost;
}

Channel::Channel(const ChannelParameters& parameters, double macrostep, std::uint64_t direction)
    : k_(parameters), macrostep_(macrostep), direction_(direction) {}

// Of the stamp alone: it does not matter what was sent before.
double Channel::random(std::int64_t stamp, std::uint64_t kind) const {
  const std::uint64_t z =
      mixed(mixed(mixed(k_.seed) + direction_) + 2 * static_cast<std::uint64_t>(stamp) + kind);
  return static_cast<double>(z >> 11) * 0x1p-53;
}

void Channel::send(const Packet& packet) {
  if (random(packet.stamp, loss) < k_.loss) return;
  const double late = k_.delay + k_.jitter * random(packet.stamp, jitter);
  flights_.push_back({packet.stamp + std::llround(late / macrostep_), packet});
}

const Packet& Channel::receive(std::int64_t i) {
  for (const Flight& flight : flights_)
    if (flight.arrival <= i && flight.packet.stamp > newest_.stamp) newest_ = flight.packet;
  std::erase_if(flights_, [&](const Flight& flight) { return flight.packet.stamp <= newest_.stamp; });
  return newest_;
}

}  // namespace mrroc::haptic
