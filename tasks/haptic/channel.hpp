// A channel from one side of a teleoperated pair to the other: late, uneven and with losses, and the same in every run
// with the same seed.
#pragma once
#include <cstdint>
#include <vector>

#include "base/spatial.hpp"

namespace mrroc::haptic {

/// How bad a channel is. Both directions of a pair have the same.
struct ChannelParameters {
  double delay{};         ///< of every packet [s], 0..0.2
  double jitter{};        ///< more than that, evenly spread from 0 to this [s]
  double loss{};          ///< share of packets that never come, 0..0.5
  std::uint64_t seed{1};  ///< of jitter and loss
};

/// @param macrostep  duration [s]
/// @return how much older than the delay the newest packet is at most [s]: by the jitter, and by the losses in succession that
///         are exceeded once in a thousand packets
[[nodiscard]] double lateness(const ChannelParameters& parameters, double macrostep);

/// What one side tells the other.
struct Packet {
  std::int64_t stamp{-1};  ///< macrostep in which it was sent; -1: none has come
  Vector3 value{
      Vector3::Zero()};  ///< from the master: way since the arms were coupled [m]; from the slave: force [N]
  double energy{};       ///< that has gone into the channel at the sender so far [J]; it never falls
};

/// One direction. A value: copies go on in the same way.
class Channel {
 public:
  Channel() = default;
  /// @param macrostep  duration [s]  @param direction  number that makes two channels of one seed differ
  Channel(const ChannelParameters& parameters, double macrostep, std::uint64_t direction);

  /// Puts a packet in, unless it gets lost. @param packet  its stamp is later than of those before
  void send(const Packet& packet);
  /// @param i  macrostep @return the newest packet that has come until then, by its stamp; what is overtaken is dropped
  const Packet& receive(std::int64_t i);
  /// @return packets that are under way
  [[nodiscard]] std::size_t under_way() const { return flights_.size(); }

 private:
  struct Flight {
    std::int64_t arrival{};
    Packet packet;
  };
  [[nodiscard]] double random(std::int64_t stamp, std::uint64_t kind) const;

  ChannelParameters k_;
  double macrostep_{0.004};
  std::uint64_t direction_{};
  std::vector<Flight> flights_;
  Packet newest_;
};

}  // namespace mrroc::haptic
