#include "base/closest_match.hpp"

#include <algorithm>
#include <vector>

namespace mrroc {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Optimal string alignment; row i holds the distances of the first i letters of a to all beginnings of b.
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = a[i - 1] == b[j - 1];
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

namespace {

/// @return as closest_match(): of those that begin with the word
std::string finished(std::string_view word, const WordSet& candidates) {
  constexpr std::size_t kTelling = 2;  // letters from which on a beginning says something
  std::string result;
  if (word.size() < kTelling) return result;
  for (auto it = candidates.lower_bound(word); it != candidates.end() && it->starts_with(word); ++it)
    if (result.empty() || it->size() < result.size()) result = *it;
  return result;
}

/// @return how many letters are the same from the beginning on
std::size_t same_beginning(std::string_view a, std::string_view b) {
  const std::size_t both = std::min(a.size(), b.size());
  std::size_t same = 0;
  while (same < both && a[same] == b[same]) ++same;
  return same;
}

/// @return as closest_match(): of those that may be misspelt
std::string corrected(std::string_view word, const WordSet& candidates, std::size_t most) {
  std::size_t best = most + 1;
  std::string result;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    const bool alike =
        distance == best && !result.empty() && same_beginning(word, candidate) > same_beginning(word, result);
    if (distance >= best && !alike) continue;
    best = distance;
    result = candidate;
  }
  return result;
}

/// @return how many letters may differ
std::size_t most_of(std::string_view word) { return std::max<std::size_t>(2, word.size() / 3); }

}  // namespace

std::string closest_match(std::string_view word, const WordSet& candidates) {
  const std::string whole = finished(word, candidates);
  return whole.empty() ? corrected(word, candidates, most_of(word)) : whole;
}

std::string closest_match(std::string_view word, const WordSet& candidates, const WordSet& orders) {
  constexpr std::size_t kSlip = 1;
  if (std::string whole = finished(word, candidates); !whole.empty()) return whole;
  if (std::string query = corrected(word, candidates, kSlip); !query.empty()) return query;
  if (std::string order = corrected(word, orders, kSlip); !order.empty()) return order;
  if (std::string query = corrected(word, candidates, most_of(word)); !query.empty()) return query;
  return finished(word, orders);
}

std::string did_you_mean(std::string_view word, const WordSet& candidates) {
  const std::string near = closest_match(word, candidates);
  return near.empty() ? near : "; did you mean '" + near + "'?";
}

}  // namespace mrroc
