#include "tasks/rubik/reading/state_reading.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/joined.hpp"
#include "tasks/rubik/reading/colour_sorting.hpp"

namespace mrroc::rubik {
namespace {

using Stickers = std::array<StickerReading, kFacelets>;

constexpr int kCentre = kStickers / 2;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

/// @return "U3" for facelet 2, as read_facelets() calls them
std::string name_of(int facelet) {
  return fmt::format("{}{}", letter(static_cast<Face>(facelet / kStickers)), facelet % kStickers + 1);
}

std::string names_of(const std::vector<int>& facelets) {
  std::vector<std::string> names;
  for (const int f : facelets) names.push_back(name_of(f));
  return joined(names, ", ");
}

/// @return whether a sticker is seen better than another time
bool is_better(const StickerReading& one, const StickerReading& other) {
  if (one.flaw != StickerFlaw::none || other.flaw != StickerFlaw::none)
    return one.flaw == StickerFlaw::none && other.flaw != StickerFlaw::none;
  const auto a = one.tint_variance();
  const auto b = other.tint_variance();
  return a[0] + a[1] < b[0] + b[1];
}

Stickers by_facelet(std::span<const FaceView> views) {
  Stickers stickers;
  std::array<bool, kFaces> there{};
  for (const FaceView& view : views) {
    const bool first = !std::exchange(there[at(number(view.shown.face))], true);
    for (int k = 0; k < kStickers; ++k) {
      StickerReading& kept = stickers[at(facelet(view.shown, k))];
      if (first || is_better(view.stickers[at(k)], kept)) kept = view.stickers[at(k)];
    }
  }
  if (std::ranges::count(there, true) != kFaces)
    throw std::invalid_argument("cube reading: a face is missing");
  return stickers;
}

class Reader {
 public:
  Reader(const Stickers& stickers, const StateReadingParameters& k) : k_(k), stickers_(stickers) {
    result_.facelets.assign(kFacelets, '?');
  }

  StateReading read() {
    if (!centres_are_known()) return result_;
    sorted_ = sort_colours(stickers_, {k_.least_deviation, k_.strange});
    std::vector<int> unsure;
    for (int f = 0; f < kFacelets; ++f) {
      const double cost = sorted_.exchange[at(f)];
      const bool sure = cost >= k_.margin && !sorted_.strange[at(f)];
      result_.confidence[at(f)] = sorted_.strange[at(f)] ? 0 : 1 - std::exp(-cost / 2);
      result_.facelets[at(f)] = letter(static_cast<Face>(sorted_.face[at(f)]));
      if (!sure) unsure.push_back(f);
    }
    if (sorted_.centres < k_.margin) return unread("the centres of two faces have the same colour");
    const auto centre = std::ranges::find_if(unsure, [](int f) { return f % kStickers == kCentre; });
    if (centre != unsure.end())
      return unread(fmt::format("the colour of {} is not certain", name_of(*centre)));
    if (!unsure.empty()) return complete(unsure);
    const FaceletReading reading = read_facelets(result_.facelets);
    result_.cube = reading.cube;
    result_.broken = reading.broken;
    return reading.cube ? result_ : unread(reading.text);
  }

 private:
  StateReading unread(std::string text) {
    result_.text = std::move(text);
    return result_;
  }

  bool centres_are_known() {
    for (int face = 0; face < kFaces; ++face) {
      const StickerReading& s = stickers_[at(kStickers * face + kCentre)];
      if (s.flaw == StickerFlaw::none) continue;
      result_.text =
          fmt::format("the centre of face {} is {}", letter(static_cast<Face>(face)), to_string(s.flaw));
      return false;
    }
    return true;
  }

  /// @return whether the sticker may have the colour of a face
  [[nodiscard]] bool may_be(int facelet, Face face) const {
    if (stickers_[at(facelet)].flaw != StickerFlaw::none || sorted_.strange[at(facelet)]) return true;
    const auto& distance = sorted_.distance[at(facelet)];
    return distance[at(number(face))] < distance[at(sorted_.face[at(facelet)])] + k_.margin;
  }

  /// Tries all ways to give the letters of unsure facelets to them.
  StateReading complete(const std::vector<int>& unsure) {
    const std::string named = names_of(unsure);
    const std::string assigned = result_.facelets;
    for (const int f : unsure) result_.facelets[at(f)] = '?';
    if (static_cast<int>(unsure.size()) > k_.most_completed)
      return unread(fmt::format("the colours of {} are not certain", named));
    std::string letters;
    for (const int f : unsure) letters += assigned[at(f)];
    std::ranges::sort(letters);
    std::vector<std::string> possible;
    do {
      std::string facelets = result_.facelets;
      bool allowed = true;
      for (std::size_t n = 0; n < unsure.size(); ++n) {
        facelets[at(unsure[n])] = letters[n];
        allowed =
            allowed && may_be(unsure[n], static_cast<Face>(std::string_view("URFDLB").find(letters[n])));
      }
      if (allowed && read_facelets(facelets).cube) possible.push_back(facelets);
    } while (std::ranges::next_permutation(letters).found);
    if (possible.size() != 1)
      return unread(fmt::format("the colours of {} are not certain, and {} cubes agree with the others",
                                named, possible.size()));
    result_.facelets = possible.front();
    result_.cube = read_facelets(result_.facelets).cube;
    result_.completed = unsure;
    result_.text = fmt::format("completed by the rules of the cube: {}", named);
    return result_;
  }

  StateReadingParameters k_;
  const Stickers& stickers_;
  SortedColours sorted_;
  StateReading result_;
};

}  // namespace

StateReading read_state(std::span<const FaceView> views, const StateReadingParameters& parameters) {
  const Stickers stickers = by_facelet(views);
  return Reader(stickers, parameters).read();
}

}  // namespace mrroc::rubik
