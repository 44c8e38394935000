// The state of a cube from stickers as cameras measure them: in any light, with some that are not known, and never
// another state than the true one.
#include "tasks/rubik/reading/state_reading.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "base/cube/move.hpp"

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
  int told = 0, completed = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const std::string truth = cube_of(seed);
    auto views = pictures.of(truth);
    std::set<int> hidden;
    const std::size_t count = 1 + seed % 9;
    while (hidden.size() < count) hidden.insert(pictures.pick(6) * kStickers + pictures.pick(4));
    for (const int f : hidden) sticker(views, f) = {.flaw = StickerFlaw::glaring};
    const StateReading reading = read_state(views);
    if (reading.cube) {
      ++completed;
      EXPECT_EQ(reading.facelets, truth) << seed;
      EXPECT_EQ(reading.completed, std::vector(hidden.begin(), hidden.end())) << "in ascending order";
      EXPECT_LE(count, static_cast<std::size_t>(StateReadingParameters{}.most_completed));
    } else {
      ++told;
      EXPECT_EQ(std::ranges::count(reading.facelets, '?'), static_cast<std::ptrdiff_t>(count));
      EXPECT_EQ(reading.broken, CubeRule::none) << "undecided, not wrong";
      EXPECT_NE(reading.text, "");
    }
  }
  EXPECT_GT(told, 5);
  EXPECT_GT(completed, 20);
}

// Two corners of which nothing but their places is known may stand in either place: twisted or not, more than one
// cube agrees with what is seen.
TEST(StateReading, TwoCubesThatAgreeWithWhatIsSeenAreNone) {
  std::vector<std::array<int, 3>> corners{{8, 9, 20}, {6, 18, 38}};  // URF and UFL
  Pictures pictures(12);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const std::string truth = cube_of(seed);
    auto views = pictures.of(truth);
    for (const auto& corner : corners)
      for (const int f : corner) sticker(views, f) = {.flaw = StickerFlaw::hidden};
    const StateReading reading = read_state(views);
    EXPECT_FALSE(reading.cube) << seed;
    EXPECT_EQ(std::ranges::count(reading.facelets, '?'), 6);
    EXPECT_NE(reading.text.find("cubes agree with the others"), std::string::npos) << reading.text;
    EXPECT_EQ(reading.text.find(" 0 cubes"), std::string::npos) << reading.text;
    EXPECT_EQ(reading.text.find(" 1 cubes"), std::string::npos) << reading.text;
    EXPECT_TRUE(reading.completed.empty());
  }
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
  const auto views = pictures.of(truth);
  FaceView blinded = views[2], other_half = views[2];
  for (std::size_t k = 0; k < kStickers; ++k)
    (k < 5 ? blinded : other_half).stickers[k] = {.flaw = StickerFlaw::glaring};
  auto half = views;
  half[2] = blinded;
  EXPECT_FALSE(read_state(half).cube);
  for (const bool swapped : {false, true}) {
    auto both = half;
    both[2] = swapped ? other_half : blinded;
    both.push_back(swapped ? blinded : other_half);
    const StateReading reading = read_state(both);
    EXPECT_EQ(reading.facelets, truth) << swapped;
    EXPECT_TRUE(reading.completed.empty()) << "every sticker is seen in one of the looks";
  }
}

// Of two looks that both see a sticker the surer one counts, whichever comes last.
TEST(StateReading, AWorseLookChangesNothing) {
  Pictures pictures(10);
  const std::string truth = cube_of(11);
  const auto views = pictures.of(truth);
  FaceView worse = views[4];
  for (StickerReading& s : worse.stickers) {
    std::swap(s.rgb[0], s.rgb[2]);
    s.deviation = 30;
  }
  auto last = views;
  last.push_back(worse);
  auto first = views;
  first.insert(first.begin(), worse);
  const StateReading alone = read_state(views);
  EXPECT_EQ(alone.facelets, truth);
  for (const auto& both : {last, first}) {
    const StateReading reading = read_state(both);
    EXPECT_EQ(reading.facelets, truth);
    EXPECT_EQ(reading.confidence, alone.confidence);
  }
}

TEST(StateReading, ACentreThatIsNotKnownLeavesTheCubeUnread) {
  auto views = Pictures(7).of(cube_of(1));
  sticker(views, 4 * kStickers + 4) = {.flaw = StickerFlaw::mixed};
  const StateReading reading = read_state(views);
  EXPECT_FALSE(reading.cube);
  EXPECT_NE(reading.text.find("centre of face L"), std::string::npos) << reading.text;
}

// With next to no blue in it white and yellow look alike, red light makes them all red, and in the dark noise is all.
TEST(StateReading, LightThatHidesAColourIsTold) {
  Pictures pictures(8);
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const std::array<double, 3>& lamp :
         {std::array{1.0, 0.9, 0.02}, std::array{1.0, 0.02, 0.02}, std::array{0.03, 0.03, 0.03}}) {
      const StateReading reading = read_state(pictures.of(cube_of(seed), lamp, 1, 3));
      EXPECT_FALSE(reading.cube) << seed;
      EXPECT_NE(reading.text, "") << seed;
    }
}

// From light that shows all colours to light that hides some: on the way cubes are read, or told, and never misread.
TEST(StateReading, LightThatHidesAColourMoreAndMoreNeverMakesItAnother) {
  Pictures pictures(13);
  int read = 0, told = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::string truth = cube_of(seed);
    for (const double blue : {1.0, 0.5, 0.3, 0.2, 0.15, 0.1, 0.07, 0.05, 0.03}) {
      const StateReading reading = read_state(pictures.of(truth, {1, 0.9, blue}, 1, 2));
      if (reading.cube) {
        EXPECT_EQ(reading.facelets, truth) << seed << " " << blue;
        ++read;
      } else {
        EXPECT_NE(reading.text, "");
        ++told;
      }
    }
  }
  EXPECT_GT(read, 40);
  EXPECT_GT(told, 20);
}

TEST(StateReading, EveryFaceMustBeThere) {
  auto views = Pictures(9).of(cube_of(2));
  views.pop_back();
  EXPECT_THROW((void)read_state(views), std::invalid_argument);
}

}  // namespace
}  // namespace mrroc::rubik
