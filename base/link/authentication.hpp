// Authenticates datagrams: each ends with a tag that only processes with the session's key can make. A tag is
// SipHash-2-4 of 128 bits over the channel's name, the message, its sender and the sender's count of
// messages.
//
//   LCM's header | channel NUL | message | sender, 8 bytes | counter, 8 bytes | tag, 16 bytes
//
// LCM's own tools listen all the same; they show the last 32 bytes as part of the message.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/link/key.hpp"
#include "base/link/replay_window.hpp"

namespace mrroc::link {

/// Length of the trailer behind the message [bytes].
inline constexpr std::size_t kTrailer = 32;

/// Key from which tags are made, derived from the key of a session.
class TagKey {
 public:
  explicit TagKey(const Key& key);
  [[nodiscard]] const std::uint8_t* data() const noexcept { return bytes_.data(); }

 private:
  std::array<std::uint8_t, 16> bytes_{};
};

/// Origin of a datagram.
struct Origin {
  std::uint64_t sender{};   ///< random number of a sender in one group
  std::uint64_t counter{};  ///< of its datagrams: 1, 2, 3...; also when it repeats a message
  bool operator==(const Origin&) const = default;
};

/// Adds the trailer. @param datagram  LCM's header, channel, NUL and message
void sign(std::vector<std::uint8_t>& datagram, const Origin& origin, const TagKey& key);

/// @param datagram  any bytes
/// @return where it comes from, or nothing unless a process that has the key has made it. Nothing is kept: a datagram that is
///         sent again by a stranger is right once more, see SenderTable. Real-time safe
[[nodiscard]] std::optional<Origin> authenticate(std::span<const std::uint8_t> datagram,
                                                 const TagKey& key) noexcept;

/// The senders that one receiver has heard, so that nothing is taken twice. Only for what authenticate() has let pass:
/// strangers never get an entry.
class SenderTable {
 public:
  /// Senders that are remembered; later ones are not heard. A terminal that gives orders is one.
  static constexpr std::size_t kMost = 65536;

  /// Decision about a datagram.
  enum class Verdict : std::uint8_t { fresh, replayed, one_too_many };
  /// @return whether it comes for the first time
  Verdict take(const Origin& origin);

 private:
  std::unordered_map<std::uint64_t, ReplayWindow> windows_;
};

}  // namespace mrroc::link
