#include "base/link/authentication.hpp"

#include <sodium.h>

#include "base/big_endian.hpp"
#include "base/fault.hpp"
#include "base/link/lcm_packet.hpp"

namespace mrroc::link {
namespace {

constexpr std::size_t kTag = crypto_shorthash_siphashx24_BYTES;
constexpr std::size_t kOrigin = kTrailer - kTag;
static_assert(kOrigin == 16 && crypto_shorthash_siphashx24_KEYBYTES == 16);

}  // namespace

TagKey::TagKey(const Key& key) {
  static_assert(crypto_kdf_KEYBYTES == Key::kSize);
  if (::sodium_init() < 0) throw FaultError(FaultCode::internal_error, "there is no cryptography");
  ::crypto_kdf_derive_from_key(bytes_.data(), bytes_.size(), 1, "mrroctag", key.bytes().data());
}

void sign(std::vector<std::uint8_t>& datagram, const Origin& origin, const TagKey& key) {
  append_big_endian(datagram, origin.sender);
  append_big_endian(datagram, origin.counter);
  const std::size_t end = datagram.size();
  datagram.resize(end + kTag);
  ::crypto_shorthash_siphashx24(datagram.data() + end, datagram.data() + kPacketHeader, end - kPacketHeader,
                                key.data());
}

std::optional<Origin> authenticate(std::span<const std::uint8_t> datagram, const TagKey& key) noexcept {
  if (datagram.size() < kPacketHeader + kTrailer) return std::nullopt;
  const auto tag = datagram.last(kTag);
  const auto covered = datagram.subspan(kPacketHeader, datagram.size() - kPacketHeader - kTag);
  std::array<std::uint8_t, kTag> right{};
  ::crypto_shorthash_siphashx24(right.data(), covered.data(), covered.size(), key.data());
  if (::sodium_memcmp(right.data(), tag.data(), kTag) != 0) return std::nullopt;
  const auto origin = covered.last(kOrigin);
  return Origin{big_endian(origin.first(kOrigin / 2)), big_endian(origin.last(kOrigin / 2))};
}

SenderTable::Verdict SenderTable::take(const Origin& origin) {
  auto it = windows_.find(origin.sender);
  if (it == windows_.end()) {
    if (windows_.size() >= kMost) return Verdict::one_too_many;
    it = windows_.emplace(origin.sender, ReplayWindow{}).first;
  }
  return it->second.take(origin.counter) ? Verdict::fresh : Verdict::replayed;
}

}  // namespace mrroc::link
