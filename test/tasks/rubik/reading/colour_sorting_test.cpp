// Sorting of stickers by colour, on cubes whose stickers are all alike but for one: their distances are
// computed by hand.
#include "tasks/rubik/reading/colour_sorting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "base/cube/face_view.hpp"
#include "tasks/rubik/reading/state_reading.hpp"

namespace mrroc::rubik {
namespace {

using Stickers = std::array<StickerReading, kFacelets>;
using Rgb = std::array<double, 3>;

constexpr std::array<Rgb, kFaces> kPaint{
    {{200, 200, 195}, {160, 14, 16}, {12, 120, 44}, {195, 178, 16}, {210, 84, 14}, {12, 44, 135}}};

Stickers solved() {
  Stickers stickers;
  for (std::size_t f = 0; f < kFacelets; ++f) stickers[f].rgb = kPaint[f / kStickers];
  return stickers;
}

double square(const Rgb& a, const Rgb& b) {
  const auto s = tint(a), t = tint(b);
  return (s[0] - t[0]) * (s[0] - t[0]) + (s[1] - t[1]) * (s[1] - t[1]);
}

/// @return squared distance of the two colours that are nearest to each other
double nearest_pair() {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < kFaces; ++a)
    for (std::size_t b = 0; b < a; ++b) least = std::min(least, square(kPaint[a], kPaint[b]));
  return least;
}

TEST(ColourSorting, DistancesOfCleanStickersAreThoseOfTheirColoursInVariancesUpToABound) {
  constexpr double kDeviation = 0.2;
  const SortedColours sorted = sort_colours(solved(), {kDeviation, 36});
  bool bounded = false, free = false;
  for (std::size_t f = 0; f < kFacelets; ++f) {
    EXPECT_EQ(sorted.face[f], static_cast<int>(f / kStickers));
    double cheapest = std::numeric_limits<double>::infinity();
    for (std::size_t face = 0; face < kFaces; ++face) {
      const double there = square(kPaint[f / kStickers], kPaint[face]) / (kDeviation * kDeviation);
      EXPECT_NEAR(sorted.distance[f][face], std::min(100., there), 1e-9);
      (there > 100 ? bounded : free) = true;
      if (face != f / kStickers) cheapest = std::min(cheapest, std::min(100., there));
    }
    EXPECT_NEAR(sorted.exchange[f], 2 * cheapest, 1e-9) << "both stickers would be wrong";
    EXPECT_FALSE(sorted.strange[f]);
  }
  EXPECT_TRUE(bounded && free);
  EXPECT_NEAR(sorted.centres, nearest_pair() / (kDeviation * kDeviation), 1e-9);
}

TEST(ColourSorting, AStickerOfWhichNothingIsKnownGetsTheColourThatIsLeft) {
  Stickers stickers = solved();
  stickers[20] = {.rgb = kPaint[0], .flaw = StickerFlaw::glaring};
  const SortedColours sorted = sort_colours(stickers, {0.2, 36});
  EXPECT_EQ(sorted.face[20], 2);
  EXPECT_EQ(sorted.exchange[20], 0);
  EXPECT_FALSE(sorted.strange[20]);
  for (const double d : sorted.distance[20]) EXPECT_EQ(d, 0);
  EXPECT_NEAR(sorted.distance[18][2], 0, 1e-12) << "it does not move the others";
}

/// One sticker of the first face is a little red.
struct Odd {
  static constexpr std::size_t kOdd = 3;
  explicit Odd(double strange_share) {
    Stickers stickers = solved();
    const Rgb paint{215, 200, 195};
    stickers[kOdd].rgb = paint;
    const double away = square(paint, kPaint[0]);
    deviation = std::sqrt(away / 4);  // two standard deviations from its centre
    sorted = sort_colours(stickers, {deviation, 4 * strange_share});
  }
  double deviation{};
  SortedColours sorted;
};

TEST(ColourSorting, AColourIsTheMeanOfItsStickers) {
  const Odd odd(1.01);
  EXPECT_EQ(odd.sorted.face[Odd::kOdd], 0);
  EXPECT_NEAR(odd.sorted.distance[Odd::kOdd][0], 4 * 64. / 81, 1e-9) << "a ninth of the way nearer";
  EXPECT_NEAR(odd.sorted.distance[0][0], 4 / 81., 1e-9);
  EXPECT_NEAR(odd.sorted.distance[4][0], 4 / 81., 1e-9) << "the centre as well";
  EXPECT_FALSE(odd.sorted.strange[Odd::kOdd]);
}

TEST(ColourSorting, AStrangeStickerDoesNotMoveItsColour) {
  const Odd odd(0.99);
  EXPECT_EQ(odd.sorted.face[Odd::kOdd], 0);
  EXPECT_NEAR(odd.sorted.distance[Odd::kOdd][0], 4, 1e-9);
  EXPECT_NEAR(odd.sorted.distance[0][0], 0, 1e-9);
  EXPECT_TRUE(odd.sorted.strange[Odd::kOdd]);
  EXPECT_EQ(std::ranges::count(odd.sorted.strange, true), 1);
}

/// @return whether exchanging stickers in a ring would make the sum of distances less
bool can_be_cheaper(const SortedColours& sorted) {
  std::array<std::array<double, kFaces>, kFaces> least{};  // of moving a sticker of one face to another one
  for (std::size_t a = 0; a < kFaces; ++a)
    for (std::size_t b = 0; b < kFaces; ++b) {
      least[a][b] = std::numeric_limits<double>::infinity();
      for (std::size_t f = 0; f < kFacelets; ++f)
        if (sorted.face[f] == static_cast<int>(a) && f % kStickers != 4)
          least[a][b] = std::min(least[a][b], sorted.distance[f][b] - sorted.distance[f][a]);
    }
  for (std::size_t by = 0; by < kFaces; ++by)
    for (std::size_t a = 0; a < kFaces; ++a)
      for (std::size_t b = 0; b < kFaces; ++b)
        least[a][b] = std::min(least[a][b], least[a][by] + least[by][b]);
  for (std::size_t a = 0; a < kFaces; ++a)
    if (least[a][a] < -1e-9) return true;
  return false;
}

TEST(ColourSorting, ColoursAreMeansWeighedByCertaintyAndTheAssignmentIsTheCheapest) {
  std::mt19937 random(2);
  std::normal_distribution<> normal;
  std::uniform_real_distribution<> uniform(0, 1);
  for (int run = 0; run < 40; ++run) {
    std::array<int, kFacelets> colour{};
    for (std::size_t f = 0; f < kFacelets; ++f) colour[f] = static_cast<int>(f / kStickers);
    for (std::size_t f = kFacelets - 1; f > 0; --f) {
      const auto g = static_cast<std::size_t>(uniform(random) * static_cast<double>(f + 1));
      if (f % kStickers != 4 && g % kStickers != 4) std::swap(colour[f], colour[g]);
    }
    Stickers stickers;
    const double noise = 0.02 + 0.05 * uniform(random);
    for (std::size_t f = 0; f < kFacelets; ++f) {
      const double light = 0.4 + 0.6 * uniform(random);
      for (std::size_t c = 0; c < 3; ++c)
        stickers[f].rgb[c] =
            light * kPaint[static_cast<std::size_t>(colour[f])][c] * std::exp(noise * normal(random));
      stickers[f].deviation = 3 * uniform(random);
      if (f % kStickers != 4 && uniform(random) < 0.05) stickers[f].flaw = StickerFlaw::hidden;
    }
    const double deviation = 0.1;
    const SortedColours sorted = sort_colours(stickers, {deviation, 36});
    EXPECT_FALSE(can_be_cheaper(sorted)) << run;
    std::array<std::array<double, 2>, kFaces> mean{};
    const auto variance = [&](std::size_t f, std::size_t k) {
      return stickers[f].tint_variance()[k] + deviation * deviation;
    };
    for (std::size_t face = 0; face < kFaces; ++face)
      for (std::size_t k = 0; k < 2; ++k) {
        double sum = 0, weights = 0;
        for (std::size_t f = 0; f < kFacelets; ++f)
          if (sorted.face[f] == static_cast<int>(face) && stickers[f].flaw == StickerFlaw::none &&
              !sorted.strange[f]) {
            sum += tint(stickers[f].rgb)[k] / variance(f, k);
            weights += 1 / variance(f, k);
          }
        mean[face][k] = sum / weights;
      }
    for (std::size_t f = 0; f < kFacelets; ++f) {
      double cheapest = std::numeric_limits<double>::infinity();
      const auto own = static_cast<std::size_t>(sorted.face[f]);
      for (std::size_t face = 0; face < kFaces; ++face) {
        double distance = 0;
        for (std::size_t k = 0; k < 2; ++k)
          distance += std::pow(tint(stickers[f].rgb)[k] - mean[face][k], 2) / variance(f, k);
        if (stickers[f].flaw != StickerFlaw::none) distance = 0;
        EXPECT_NEAR(sorted.distance[f][face], std::min(100., distance), 1e-9) << run << ' ' << f;
      }
      for (std::size_t g = 0; g < kFacelets; ++g) {
        const auto others = static_cast<std::size_t>(sorted.face[g]);
        if (others == own || g % kStickers == 4) continue;
        const auto& d = sorted.distance;
        cheapest = std::min(cheapest, d[f][others] - d[f][own] + d[g][own] - d[g][others]);
      }
      EXPECT_NEAR(sorted.exchange[f], stickers[f].flaw == StickerFlaw::none ? std::max(0., cheapest) : 0,
                  1e-12);
    }
  }
}

std::vector<FaceView> views_of(const Stickers& stickers) {
  std::vector<FaceView> views;
  for (int face = 0; face < kFaces; ++face) {
    FaceView& view = views.emplace_back(FaceView{.shown = {static_cast<Face>(face), 0}});
    for (int k = 0; k < kStickers; ++k)
      view.stickers[static_cast<std::size_t>(k)] = stickers[static_cast<std::size_t>(facelet(view.shown, k))];
  }
  return views;
}

StateReading without(std::initializer_list<std::size_t> hidden, const StateReadingParameters& k = {}) {
  Stickers stickers = solved();
  for (const std::size_t f : hidden) stickers[f] = {.flaw = StickerFlaw::hidden};
  return read_state(views_of(stickers), k);
}

TEST(StateReading, NamesFaceletsByTheirFaceAndTheirNumberFromOne) {
  EXPECT_EQ(without({}).text, "");
  EXPECT_EQ(without({0}).text, "completed by the rules of the cube: U1");
  EXPECT_EQ(without({53}).text, "completed by the rules of the cube: B9");
  EXPECT_EQ(without({9, 17, 29}).text, "completed by the rules of the cube: R1, R9, D3");
  EXPECT_EQ(without({31}).text, "the centre of face D is hidden");
}

TEST(StateReading, CompletesAsManyStickersAsItMay) {
  StateReadingParameters k;
  k.most_completed = 2;
  EXPECT_TRUE(without({1, 3}, k).cube);
  const StateReading more = without({1, 3, 5}, k);
  EXPECT_FALSE(more.cube);
  EXPECT_EQ(more.text, "the colours of U2, U4, U6 are not certain");
  EXPECT_EQ(std::ranges::count(more.facelets, '?'), 3);
}

TEST(StateReading, ConfidenceComesFromTheCheapestExchange) {
  StateReadingParameters k;
  k.least_deviation = 0.4;  // so that colours are only some variances apart
  k.margin = 0.1;
  const SortedColours sorted = sort_colours(solved(), {k.least_deviation, k.strange});
  const StateReading reading = read_state(views_of(solved()), k);
  double least = 1;
  for (std::size_t f = 0; f < kFacelets; ++f) {
    EXPECT_NEAR(reading.confidence[f], 1 - std::exp(-sorted.exchange[f] / 2), 1e-12);
    least = std::min(least, reading.confidence[f]);
  }
  EXPECT_LT(least, 0.999) << "or nothing is tested";
}

TEST(StateReading, TwoCentresOfOneColourAreTold) {
  StateReadingParameters k;
  const double apart = nearest_pair() / (k.least_deviation * k.least_deviation);
  k.margin = 0.99 * apart;
  EXPECT_TRUE(read_state(views_of(solved()), k).cube);
  k.margin = 1.01 * apart;
  const StateReading reading = read_state(views_of(solved()), k);
  EXPECT_FALSE(reading.cube);
  EXPECT_EQ(reading.text, "the centres of two faces have the same colour");
}

}  // namespace
}  // namespace mrroc::rubik
