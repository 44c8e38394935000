// Finds the word that was probably meant: for messages about unknown keys and names.
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

/// @return the shortest candidate that begins with the word, which has two letters or more, and was not finished; else the
///         candidate nearest to the word, of equals the one that begins like it for longest; empty when none is near: at
///         most a third of the word's letters may differ, and two of a short word
[[nodiscard]] std::string closest_match(std::string_view word, const WordSet& candidates);

/// @return the end of a sentence that says what there is not: "; did you mean 'NEAR'?"; empty when none is near
[[nodiscard]] std::string did_you_mean(std::string_view word, const WordSet& candidates);

/// closest_match() where some candidates do something that cannot be undone, such as to start a machine, and others only tell.
/// @param orders  of these one is answered only when it has one slip, or is not finished, and no other candidate is as near
[[nodiscard]] std::string closest_match(std::string_view word, const WordSet& candidates,
                                        const WordSet& orders);

}  // namespace mrroc
