#include "tasks/rubik/solver/packed_table.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace mrroc::rubik {
namespace {

template <int Bits>
void holds_what_is_set(int columns) {
  SCOPED_TRACE(columns);
  std::mt19937_64 random(Bits);
  const PackedLayout<Bits> layout{3, columns};
  std::vector<std::uint8_t> table(layout.bytes(2), 0xff);
  std::vector<unsigned> values;
  const auto row = [&](std::size_t k) { return table.data() + k * layout.row_bytes(); };
  for (std::size_t r = 0; r < 6; ++r)
    for (int c = 0; c < columns; ++c) {
      values.push_back(static_cast<unsigned>(random() & PackedLayout<Bits>::kMask));
      set_packed<Bits>(row(r), c, values.back());
    }
  for (std::size_t r = 0; r < 6; ++r)
    for (unsigned value = 0; value <= PackedLayout<Bits>::kMask; ++value) {
      std::vector<int> expected, found;
      for (int c = 0; c < columns; ++c) {
        ASSERT_EQ(get_packed<Bits>(row(r), c), values[r * columns + c]);
        if (values[r * columns + c] == value) expected.push_back(c);
      }
      for_each_packed<Bits>(row(r), columns, value, [&found](int c) { found.push_back(c); });
      EXPECT_EQ(found, expected);
    }
}

// The last row ends with the table's last byte: the address sanitizer sees who reads behind it.
TEST(PackedTable, HoldsWhatIsSet) {
  for (const int columns : {1, 2, 7, 15, 16, 17, 31, 32, 33, 71, 128}) {
    holds_what_is_set<2>(columns);
    holds_what_is_set<4>(columns);
  }
}

}  // namespace
}  // namespace mrroc::rubik
