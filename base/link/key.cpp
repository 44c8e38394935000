#include "base/link/key.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <sodium.h>
#include <unistd.h>

#include <chrono>

#include "base/fault.hpp"
#include "base/link/private_folder.hpp"

namespace mrroc::link {
namespace {

constexpr std::size_t kDigits = 2 * Key::kSize;

int value_of(char digit) noexcept {
  if (digit >= '0' && digit <= '9') return digit - '0';
  if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
  if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
  return -1;
}

/// @return the first line of a text
std::string_view line_of(std::string_view text) { return text.substr(0, text.find('\n')); }

}  // namespace

Key Key::random() {
  if (::sodium_init() < 0) throw FaultError(FaultCode::internal_error, "there are no random numbers");
  Key key;
  ::randombytes_buf(key.bytes_.data(), kSize);
  return key;
}

std::optional<Key> Key::parse(std::string_view hex) noexcept {
  if (hex.size() != kDigits) return std::nullopt;
  Key key;
  for (std::size_t k = 0; k < kSize; ++k) {
    const int high = value_of(hex[2 * k]), low = value_of(hex[2 * k + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    key.bytes_[k] = static_cast<std::uint8_t>(high << 4 | low);
  }
  return key;
}

std::string Key::hex() const {
  std::string text;
  for (const std::uint8_t b : bytes_) text += fmt::format("{:02x}", b);
  return text;
}

Key read_key(int file) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::seconds(10);
  std::string line;
  char c = 0;
  while (line.size() <= kDigits) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd ready{file, POLLIN, 0};
    if (left <= 0 || ::poll(&ready, 1, static_cast<int>(left)) <= 0 || ::read(file, &c, 1) != 1 || c == '\n')
      break;
    line += c;
  }
  if (const auto key = Key::parse(line)) return *key;
  throw FaultError(FaultCode::bad_usage, fmt::format("there is no key of a session on descriptor {}", file),
                   "what starts a program on another host has to pass on its standard input");
}

Key read_key_file(const std::filesystem::path& path) {
  std::string why;
  const auto text = read_own_file(path, OwnFile::secret, why);
  const auto key = text ? Key::parse(line_of(*text)) : std::nullopt;
  if (key) return *key;
  if (text) why = "it holds no key of a session";
  throw FaultError(FaultCode::bad_usage, fmt::format("cannot use the key {}: {}", path.string(), why),
                   "give the .key file of a session, owned by you, with rights 600");
}

void write_key_file(const std::filesystem::path& path, const Key& key) {
  std::string why;
  if (!write_own_file(path, key.hex() + "\n", why))
    throw FaultError(FaultCode::cannot_write, fmt::format("cannot write {}: {}", path.string(), why));
}

}  // namespace mrroc::link
