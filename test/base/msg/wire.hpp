// Messages as bytes of the wire, for tests.
#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace mrroc::test {

/// Over the wire: encoded, decoded and compared as bytes, which NaN and -0 survive too.
template <class M>
M sent(const M& m) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(m.getEncodedSize()));
  EXPECT_EQ(m.encode(bytes.data(), 0, m.getEncodedSize()), m.getEncodedSize());
  M received{};
  EXPECT_EQ(received.decode(bytes.data(), 0, m.getEncodedSize()), m.getEncodedSize());
  return received;
}
template <class M>
std::vector<std::uint8_t> bytes_of(const M& m) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(m.getEncodedSize()));
  m.encode(bytes.data(), 0, m.getEncodedSize());
  return bytes;
}

/// A value goes to a message, over the wire, back to a value, and gives the same message again.
template <class V, class From>
void expect_round_trip(const V& value, From from) {
  const auto m = to_message(value);
  const V back = from(sent(m));
  EXPECT_EQ(bytes_of(to_message(back)), bytes_of(m));
}

/// Calls see(m) for messages of type M whose fields are random bits.
template <class M, class See>
void with_random_bytes(See see) {
  std::mt19937_64 random(7);
  const int size = M{}.getEncodedSize();
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  for (int k = 0; k < 2000; ++k) {
    M m{};
    m.encode(bytes.data(), 0, size);
    // The first eight bytes say what type it is.
    for (std::size_t b = 8; b < bytes.size(); ++b)
      if (k % 2 == 0 || random() % 4 == 0) bytes[b] = static_cast<std::uint8_t>(random());
    ASSERT_EQ(m.decode(bytes.data(), 0, size), size);
    see(m);
  }
}

}  // namespace mrroc::test
