// Seeds for the parts of a simulation.
#pragma once
#include <cstdint>

namespace mrroc::sim {

/// @return a well mixed seed, also from neighbouring numbers (splitmix64, S. Vigna)
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

}  // namespace mrroc::sim
