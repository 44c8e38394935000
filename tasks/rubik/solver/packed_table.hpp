// Small numbers, two or four bits each, in pages and rows.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace mrroc::rubik {

/// Layout of a table's entries in memory. Rows begin at whole bytes.
/// @tparam Bits  2 or 4 per entry
template <int Bits>
struct PackedLayout {
  static constexpr int kPerByte = 8 / Bits;  ///< entries in a byte
  /// The largest entry; also what an entry begins with.
  static constexpr unsigned kMask = (1U << Bits) - 1;

  int rows;     ///< of a page
  int columns;  ///< entries of a row

  /// Bytes of a row, of a page, and of a table.
  [[nodiscard]] constexpr std::size_t row_bytes() const {
    return (static_cast<std::size_t>(columns) + kPerByte - 1) / kPerByte;
  }
  [[nodiscard]] constexpr std::size_t page_bytes() const { return row_bytes() * rows; }
  [[nodiscard]] constexpr std::size_t bytes(int pages) const { return page_bytes() * pages; }
};

/// @return entry number column of the row that begins there
template <int Bits>
[[nodiscard]] inline unsigned get_packed(const std::uint8_t* row, unsigned column) {
  constexpr unsigned kEach = PackedLayout<Bits>::kPerByte;
  return (row[column / kEach] >> (column % kEach * Bits)) & PackedLayout<Bits>::kMask;
}

/// Sets an entry that is full of ones.
template <int Bits>
inline void set_packed(std::uint8_t* row, unsigned column, unsigned value) {
  constexpr unsigned kEach = PackedLayout<Bits>::kPerByte;
  const unsigned hole = (PackedLayout<Bits>::kMask ^ value) << (column % kEach * Bits);
  row[column / kEach] = static_cast<std::uint8_t>(row[column / kEach] & ~hole);
}

/// Calls found(column) for each entry of the row that has the value.
template <int Bits, class Found>
inline void for_each_packed(const std::uint8_t* row, int columns, unsigned value, Found&& found) {
  static_assert(std::endian::native == std::endian::little);
  constexpr std::uint64_t kOnes = ~std::uint64_t{0} / PackedLayout<Bits>::kMask;
  constexpr int kPerByte = PackedLayout<Bits>::kPerByte;
  constexpr int kPerWord = 64 / Bits;
  const std::uint64_t pattern = kOnes * value;
  for (int first = 0; first < columns; first += kPerWord) {
    std::uint64_t word = 0;
    // The next row may be another thread's: no byte of it is read.
    if (columns - first >= kPerWord)
      std::memcpy(&word, row + first / kPerByte, sizeof word);
    else
      std::memcpy(&word, row + first / kPerByte, (columns - first + kPerByte - 1) / kPerByte);
    word ^= pattern;
    word |= word >> 1;
    if constexpr (Bits == 4) word |= word >> 2;
    for (std::uint64_t equal = ~word & kOnes; equal != 0; equal &= equal - 1) {
      const int column = first + std::countr_zero(equal) / Bits;
      if (column >= columns) return;
      found(column);
    }
  }
}

}  // namespace mrroc::rubik
