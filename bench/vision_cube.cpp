// Faces of the cube in the track arm's hand, read in all kinds of light, to the state of the whole cube.
#include "base/cube/move.hpp"
#include "bench/shown_cube.hpp"
#include "bench/vision.hpp"
#include "sim/camera/renderer.hpp"
#include "tasks/rubik/reading/state_reading.hpp"
#include "vsp/cube_face/cube_face_sensor.hpp"

namespace mrroc::bench {
namespace {

using cube::FaceView;

constexpr int kCubes = 168;  // six faces each

/// What became of the faces under one kind of light.
struct Tally {
  int faces{}, named_wrong{}, named_unsure{}, wrong{}, flagged{}, unread{}, completed{};
};

StickerColour colour_of(char letter) {
  return static_cast<StickerColour>(std::string_view("URFDLB").find(letter));
}

class FaceBench {
 public:
  FaceBench() : shown_(41), sensor_(shown_.camera().model, shown_.places()) {}

  void look_at_cube(int number, Lighting lighting, Tally& tally) {
    std::mt19937_64 random(static_cast<std::uint64_t>(number) + 1);
    const cube::Cube cube = cube::random_cube(random);
    const std::string facelets = cube::to_facelets(cube);
    const CubeLight light = shown_.draw_light(lighting);
    rubik::StateReading state;
    std::vector<FaceView> views;
    for (int reading = 0; reading < rubik::kReadings && !state.cube; ++reading) {
      if (reading > 0) tally.flagged += cube::kFaces;
      for (const Look& look : shown_.looks(reading))
        views.push_back(look_at_face(look, cube, light, facelets, tally));
      state = rubik::read_state(views);
    }
    tally.completed += static_cast<int>(state.completed.size());
    if (!state.cube) {
      ++tally.unread;
      return;
    }
    for (int f = 0; f < cube::kFaces; ++f) {
      const auto first = static_cast<std::size_t>(kStickers * f);
      if (state.facelets.substr(first, kStickers) != facelets.substr(first, kStickers)) ++tally.wrong;
    }
  }

  [[nodiscard]] double longest_ms() const { return longest_; }

 private:
  FaceView look_at_face(const Look& look, const cube::Cube& cube, const CubeLight& light,
                        const std::string& facelets, Tally& tally) {
    const Image picture =
        renderer_.render(shown_.show(look, cube, light), shown_.camera().place, tally.faces++);
    const double begun = thread_ms();
    const CubeFaceReading reading = sensor_.detect(picture.view(), tally.faces, 0);
    longest_ = std::max(longest_, thread_ms() - begun);
    const FaceView view = cube::view_of(look.R_GC, reading);
    judge_names(reading, view.shown, facelets, tally);
    return view;
  }

  void judge_names(const CubeFaceReading& reading, cube::ShownFace shown, const std::string& facelets,
                   Tally& tally) {
    if (!reading.valid) {
      ++tally.named_unsure;
      return;
    }
    bool wrong = false;
    for (int k = 0; k < kStickers; ++k)
      wrong = wrong || reading.stickers[static_cast<std::size_t>(k)].colour !=
                           colour_of(facelets[static_cast<std::size_t>(cube::facelet(shown, k))]);
    tally.named_wrong += wrong ? 1 : 0;
  }

  ShownCube shown_;
  camera::Renderer renderer_{shown_.camera().model, camera::exact_profile()};
  vsp::CubeFaceSensor sensor_;
  double longest_{};
};

}  // namespace

Figures run_cube_face_figures() {
  FaceBench bench;
  std::array<Tally, kLightings> all;
  for (int k = 0; k < kCubes; ++k)
    bench.look_at_cube(k, static_cast<Lighting>(k % kLightings),
                       all[static_cast<std::size_t>(k % kLightings)]);
  const auto sum = [&](int Tally::*what) {
    int total = 0;
    for (const Tally& t : all) total += t.*what;
    return static_cast<double>(total);
  };
  const auto flagged = [&](Lighting l) {
    return static_cast<double>(all[static_cast<std::size_t>(l)].flagged);
  };
  return {
      {"cube_misread", sum(&Tally::wrong), "",
       "faces of 168 cubes, 1,008 in four kinds of light, that were read wrong without a word"},
      {"cube_flagged", sum(&Tally::flagged), "",
       "faces of cubes that had to be shown again, all six of each"},
      {"cube_flagged_white", flagged(Lighting::white), "", "of them in white light"},
      {"cube_flagged_coloured", flagged(Lighting::coloured), "", "of them in coloured light"},
      {"cube_flagged_dim", flagged(Lighting::dim), "", "of them with 20 to 40 % of the light"},
      {"cube_flagged_glaring", flagged(Lighting::glaring), "", "of them with the lamp's image on the face"},
      {"cube_unread", sum(&Tally::unread), "", "cubes without a state when all faces had been shown again"},
      {"cube_completed", sum(&Tally::completed), "", "stickers that the rules of the cube decided"},
      {"cube_face_pictures", sum(&Tally::faces), "", "pictures of faces, those shown again included"},
      {"cube_face_misnamed", sum(&Tally::named_wrong), "",
       "valid readings of one picture that name a colour wrong"},
      {"cube_face_unsure", sum(&Tally::named_unsure), "", "readings of one picture that are not valid"},
      {"cube_face_ms_max", bench.longest_ms(), "ms", "processor time of the longest reading"},
  };
}

}  // namespace mrroc::bench
