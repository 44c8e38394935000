// The state of a cube from stickers as cameras measure them: in any light, with some that are not known, and never
// another state than the true one.
#include "tasks/rubik/reading/state_reading.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tasks/rubik/cube/move.hpp"

namespace mrroc::rubik {
namespace {

constexpr std::array<std::array<double, 3>, kFaces> kPaint{
    {{200, 200, 195}, {160, 14, 16}, {12, 120, 44}, {195, 178, 16}, {210, 84, 14}, {12, 44, 135}}};

/// What a camera says of a whole cube.
class Pictures {
 public:
  explicit Pictures(unsigned seed) : random_(seed) {}

  /// @param lamp  its red, green, blue @param dim  of every face, at random down to that
  std::vector<FaceView> of(const std::string& facelets, const std::array<double, 3>& lamp = {1, 1, 1},
                           double dim = 1, double noise = 1) {
    std::vector<FaceView> views;
    for (int f = 0; f < kFaces; ++f) {
      FaceView view;
      view.shown = {static_cast<Face>(f), pick(4)};
      const double light = std::uniform_real_distribution<>(dim, 1)(random_);
      for (int k = 0; k < kStickers; ++k) {
        const auto letter = static_cast<std::size_t>(facelet(view.shown, k));
        StickerReading& s = view.stickers[static_cast<std::size_t>(k)];
        const auto& paint = kPaint[std::string_view("URFDLB").find(facelets[letter])];
        for (std::size_t c = 0; c < 3; ++c)
          s.rgb[c] =
              std::max(0.0, lamp[c] * light * paint[c] + noise * std::normal_distribution<>()(random_));
        s.deviation = noise / 2;
      }
      views.push_back(view);
    }
    return views;
  }
  int pick(int n) { return std::uniform_int_distribution<>(0, n - 1)(random_); }
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }

 private:
  std::mt19937 random_;
};

StickerReading& sticker(std::vector<FaceView>& views, int wanted) {
  for (FaceView& view : views)
    for (int k = 0; k < kStickers; ++k)
      if (facelet(view.shown, k) == wanted) return view.stickers[static_cast<std::size_t>(k)];
  throw std::out_of_range("no such facelet");
}

std::string cube_of(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  return to_facelets(random_cube(random));
}

TEST(StateReading, ReadsCubesInLightOfAnyTintAndStrength) {
  Pictures pictures(1);
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const std::string truth = seed == 1 ? to_facelets({}) : cube_of(seed);
    const std::array<double, 3> lamp{pictures.uniform(0.6, 1.2), pictures.uniform(0.6, 1.2),
                                     pictures.uniform(0.6, 1.2)};
    const StateReading reading = read_state(pictures.of(truth, lamp, 0.3));
    EXPECT_TRUE(reading.cube) << seed << ' ' << reading.text;
    EXPECT_EQ(reading.facelets, truth) << seed;
    EXPECT_TRUE(reading.completed.empty());
    EXPECT_GT(std::ranges::min(reading.confidence), 0.99) << seed;
  }
}

TEST(StateReading, CompletesAHiddenSticker) {
  Pictures pictures(2);
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const std::string truth = cube_of(seed);
    auto views = pictures.of(truth);
    int hidden = pictures.pick(kFacelets);
    if (hidden % kStickers == 4) ++hidden;
    sticker(views, hidden) = {.flaw = StickerFlaw::hidden};
    const StateReading reading = read_state(views);
    EXPECT_EQ(reading.facelets, truth);
    EXPECT_EQ(reading.completed, std::vector{hidden});
    EXPECT_LT(reading.confidence[static_cast<std::size_t>(hidden)], 0.01);
    EXPECT_NE(reading.text, "");
  }
}

TEST(StateReading, GuessesNothing) {
  Pictures pictures(3);
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const std::string truth = cube_of(seed);
    auto views = pictures.of(truth);
    for (int n = 0; n < 1 + static_cast<int>(seed) % 9; ++n)
      sticker(views, pictures.pick(6) * kStickers + pictures.pick(4)) = {.flaw = StickerFlaw::glaring};
    const StateReading reading = read_state(views);
    if (reading.cube) {
      EXPECT_EQ(reading.facelets, truth) << seed;
    } else {
      ++told;
      EXPECT_GT(std::ranges::count(reading.facelets, '?'), 0);
      EXPECT_NE(reading.text, "");
    }
  }
  EXPECT_GT(told, 5);
}

TEST(StateReading, AnExchangeThatNoCubeHasBreaksARuleAndIsTold) {
  Pictures pictures(4);
  std::string painted = to_facelets({});
  std::swap(painted[0], painted[9]);  // a corner with two stickers of opposite hands
  const StateReading reading = read_state(pictures.of(painted));
  EXPECT_FALSE(reading.cube);
  EXPECT_EQ(reading.broken, CubeRule::piece);
  EXPECT_NE(reading.text, "");
}

TEST(StateReading, ATwistedCornerBreaksARuleOfTheWholeCube) {
  Cube twisted;
  twisted.corners[0] = 1;
  const StateReading reading = read_state(Pictures(5).of(to_facelets(twisted)));
  EXPECT_FALSE(reading.cube);
  EXPECT_EQ(reading.broken, CubeRule::twist);
  EXPECT_NE(reading.text, "");
}

TEST(StateReading, ASecondLookCountsWhereItSeesBetter) {
  Pictures pictures(6);
  const std::string truth = cube_of(9);
  auto views = pictures.of(truth);
  for (int k = 0; k < kStickers; ++k) sticker(views, kStickers * 2 + k) = {.flaw = StickerFlaw::glaring};
  EXPECT_FALSE(read_state(views).cube);
  auto again = pictures.of(truth)[2];
  again.stickers[8] = {.flaw = StickerFlaw::hidden};
  views.push_back(again);
  EXPECT_EQ(read_state(views).facelets, truth);
}

TEST(StateReading, ACentreThatIsNotKnownLeavesTheCubeUnread) {
  auto views = Pictures(7).of(cube_of(1));
  sticker(views, 4 * kStickers + 4) = {.flaw = StickerFlaw::mixed};
  const StateReading reading = read_state(views);
  EXPECT_FALSE(reading.cube);
  EXPECT_NE(reading.text.find("centre of face L"), std::string::npos) << reading.text;
}

TEST(StateReading, LightThatHidesAColourIsToldAndNeverMisread) {
  Pictures pictures(8);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::string truth = cube_of(seed);
    // With next to no blue in it white and yellow look alike, red light makes them all red.
    for (const std::array<double, 3>& lamp :
         {std::array{1.0, 0.9, 0.02}, std::array{1.0, 0.02, 0.02}, std::array{0.03, 0.03, 0.03}}) {
      const StateReading reading = read_state(pictures.of(truth, lamp, 1, 3));
      if (reading.cube) {
        EXPECT_EQ(reading.facelets, truth);
      }
    }
  }
}

TEST(StateReading, EveryFaceMustBeThere) {
  auto views = Pictures(9).of(cube_of(2));
  views.pop_back();
  EXPECT_THROW((void)read_state(views), std::invalid_argument);
}

}  // namespace
}  // namespace mrroc::rubik
