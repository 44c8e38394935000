// Tables on disk: written once, mapped into memory, checked when opened.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace mrroc::rubik {

/// Bytes in memory, of a file or of their own. Movable.
class Memory {
 public:
  Memory() = default;
  /// Zeroed memory of its own, in large pages where the system has them.
  /// @throws std::bad_alloc
  explicit Memory(std::size_t bytes);
  /// @return a file's content, read-only; empty when it cannot be mapped or is not longer than offset
  static Memory of_file(const std::filesystem::path& file, std::size_t offset);
  ~Memory();
  Memory(Memory&& other) noexcept;
  Memory& operator=(Memory&& other) noexcept;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  /// @return first byte of the content; null when empty
  [[nodiscard]] const std::uint8_t* data() const { return base_ + offset_; }
  /// @return the bytes for writing; of memory of its own only
  [[nodiscard]] std::span<std::uint8_t> writable() { return {base_, size_}; }
  /// @return the content
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return {data(), size_ - offset_}; }

 private:
  std::uint8_t* base_{};
  std::size_t size_{};
  std::size_t offset_{};
};

/// Expected properties of a table file.
struct TableKind {
  std::string name;       ///< also the file's name, with ".table"
  std::uint32_t version;  ///< of the content; a file of another version is damaged
  std::size_t bytes;      ///< of the content
};

/// Result of opening a table.
enum class TableSource : std::uint8_t {
  file,      ///< the file was there and whole
  made,      ///< it was filled and written
  unwritten  ///< it was filled, but could not be written: the next program has to fill it again
};

/// A table that is read-only now.
struct OpenTable {
  Memory memory;               ///< its content
  TableSource source{};        ///< where the content is from
  std::string failure_reason;  ///< why the file was not used or not written; empty if there was none
};

/// Opens a table in the folder; fills and writes it when it is missing or damaged. It appears under its name only
/// when it is complete. What processes that were ended while they wrote have left is removed when one is written.
/// @param fill  fills the bytes, which are zero
[[nodiscard]] OpenTable open_table(const std::filesystem::path& folder, const TableKind& kind,
                                   const std::function<void(std::span<std::uint8_t>)>& fill);

/// @return checksum of the bytes, about as fast as they can be read; not cryptographic
[[nodiscard]] std::uint64_t checksum(std::span<const std::uint8_t> bytes);

/// @return the folder for tables: $XDG_CACHE_HOME/mrroc, else ~/.cache/mrroc, else a folder for temporary files
[[nodiscard]] std::filesystem::path table_folder();

}  // namespace mrroc::rubik
