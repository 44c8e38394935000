#include "base/cube/cube.hpp"

namespace mrroc::cube {
namespace {

template <std::size_t N>
bool odd(const std::array<std::uint8_t, N>& slots, int values_per_piece) {
  bool result = false;
  for (std::size_t j = 0; j < N; ++j)
    for (std::size_t k = j + 1; k < N; ++k)
      result ^= slots[k] / values_per_piece < slots[j] / values_per_piece;
  return result;
}

}  // namespace

int twist_sum(const Cube& cube) {
  int sum = 0;
  for (const std::uint8_t value : cube.corners) sum += value % 3;
  return sum % 3;
}

int flip_sum(const Cube& cube) {
  int sum = 0;
  for (const std::uint8_t value : cube.edges) sum += value % 2;
  return sum % 2;
}

bool odd_corners(const Cube& cube) { return odd(cube.corners, 3); }

bool odd_edges(const Cube& cube) { return odd(cube.edges, 2); }

bool is_reachable(const Cube& cube) {
  return twist_sum(cube) == 0 && flip_sum(cube) == 0 && odd_corners(cube) == odd_edges(cube);
}

}  // namespace mrroc::cube
