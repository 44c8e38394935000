// The word that was probably meant: for messages about unknown keys and names.
#pragma once
#include <cstddef>
#include <set>
#include <string>
#include <string_view>

namespace mrroc {

/// Words in alphabetical order, searchable by view.
using WordSet = std::set<std::string, std::less<>>;

/// @return number of insertions, deletions, replacements and exchanges of neighbours that make b from a
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// @return the candidate nearest to the word, the first of equals; empty when none is near: at most a third
/// of
///         the word's letters may differ, and two of a short word
[[nodiscard]] std::string nearest(std::string_view word, const WordSet& candidates);

}  // namespace mrroc
