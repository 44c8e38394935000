// The secret key of a session; its processes and terminals sign messages with it. Not for the servo step.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace mrroc::link {

/// 32 random bytes.
class Key {
 public:
  static constexpr std::size_t kSize = 32;  ///< [bytes]

  /// @return one that nobody has had before
  [[nodiscard]] static Key random();
  /// @param hex  two digits a byte, of either case @return nothing unless it is exactly one key
  [[nodiscard]] static std::optional<Key> parse(std::string_view hex) noexcept;

  /// @return as parse() takes it
  [[nodiscard]] std::string hex() const;
  [[nodiscard]] const std::array<std::uint8_t, kSize>& bytes() const noexcept { return bytes_; }
  bool operator==(const Key&) const = default;

 private:
  std::array<std::uint8_t, kSize> bytes_{};
};

/// Reads a key as the first line of an open file, such as a pipe; waits 10 s for it.
/// @param file  descriptor, read up to the end of that line
/// @throws FaultError bad_usage  there is none
[[nodiscard]] Key read_key(int file);

/// Reads a key from a file that is the user's own, and that nobody else can open.
/// @throws FaultError bad_usage  it is not, or holds none
[[nodiscard]] Key read_key_file(const std::filesystem::path& path);

/// Writes a new file that only its user can open.
/// @throws FaultError cannot_write  also when something of that name is there, be it a link
void write_key_file(const std::filesystem::path& path, const Key& key);

}  // namespace mrroc::link
