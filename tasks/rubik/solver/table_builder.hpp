// Fills a pruning table: for every state of a coset space the fewest turns to the solved one.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tasks/rubik/solver/coset_space.hpp"
#include "tasks/rubik/solver/packed_table.hpp"

namespace mrroc::rubik {

/// Distances that two bits can tell apart: up to base, base + 1, base + 2, more. Four bits hold the distance itself.
inline constexpr int kTwoBitBase = 9;

/// Called with how much of the table is filled, 0 to 1; may be empty.
using Progress = std::function<void(double)>;

/// Breadth-first search, in memory that lies page by page as the space does.
/// @tparam Bits  4: entries are distances, up to deepest + 1; 2: max(0, distance - kTwoBitBase), at most 3
/// @param deepest  longest distance to tell apart, at most 14; of no meaning with two bits
/// @param table  PackedLayout<Bits>{rows, columns}.bytes(pages) bytes
/// @param threads  at least 1
/// @return states (not entries) by distance, up to deepest; with two bits up to kTwoBitBase + 2
template <int Bits>
std::vector<std::uint64_t> build_table(const CosetSpace& space, std::span<std::uint8_t> table, int deepest,
                                       int threads, const Progress& progress);

}  // namespace mrroc::rubik
