#include "base/cube/cube_text.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/cube/character.hpp"
#include "base/cube/facelets.hpp"
#include "base/cube/move.hpp"

namespace mrroc::cube {
namespace {

constexpr std::size_t kFewestFacelets = 40;  // turns in one word without any sign are fewer
constexpr std::size_t kMostSigns = 2;        // that slip into facelets
constexpr std::size_t kShortestGroup = 3;    // of facelets behind a blank: a row

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t end = 0; end < text.size();) {
    const std::size_t begin = std::min(text.find_first_not_of(kBlanks, end), text.size());
    end = std::min(text.find_first_of(kBlanks, begin), text.size());
    if (end > begin) words.push_back(text.substr(begin, end - begin));
  }
  return words;
}

bool is_sign(std::string_view character) {
  return character == "2" || character == "3" || character == "," || is_apostrophe(character);
}

std::size_t signs_in(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < text.size();) {
    const std::string_view character = character_at(text, k);
    count += is_sign(character) ? 1 : 0;
    k += character.size();
  }
  return count;
}

/// @return whether every word may be one turn, rightly written or not
bool one_by_one(const std::vector<std::string_view>& words) {
  return std::ranges::all_of(words, [](std::string_view w) { return characters(w) == 1 + signs_in(w); });
}

/// @return whether a word goes on with facelets, and is not a remark behind them
bool is_group(std::string_view word) {
  return word.size() >= kShortestGroup && signs_in(word) == 0 &&
         kFaceLetters.find(word[0]) != std::string_view::npos;
}

/// @return the part of a line that is the facelets, if it is such a line
std::string_view facelets_of(std::string_view line) {
  const std::vector<std::string_view> words = words_of(line);
  const bool in_groups = !words.empty() && characters(words.front()) < kFewestFacelets;
  std::size_t letters = 0;
  std::string_view part;
  for (const std::string_view word : words) {
    if (letters >= kFacelets || (letters > 0 && !in_groups && !is_group(word))) break;
    letters += characters(word);
    part = line.substr(0, static_cast<std::size_t>(word.data() + word.size() - line.data()));
  }
  return part;
}

}  // namespace

bool means_facelets(std::string_view text) {
  const std::vector<std::string_view> words = words_of(text);
  std::string all;
  for (const std::string_view word : words) all += word;
  if (characters(all) < kFewestFacelets || signs_in(all) > kMostSigns) return false;
  return !one_by_one(words) || std::ranges::adjacent_find(all) != all.end();
}

Cube read_cube(std::string_view text) {
  return means_facelets(text) ? cube_from_facelets(text) : after({}, parse_moves(text));
}

Cube read_cube_line(std::string_view line) {
  const std::string_view facelets = facelets_of(line);
  return means_facelets(facelets) ? cube_from_facelets(facelets) : read_cube(line);
}

}  // namespace mrroc::cube
