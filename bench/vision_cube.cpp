// Faces of the cube in the track arm's hand, read in all kinds of light, to the state of the whole cube.
#include <cmath>
#include <numbers>

#include "bench/vision.hpp"
#include "sim/camera/cell_scene.hpp"
#include "sim/camera/cube_view.hpp"
#include "sim/camera/renderer.hpp"
#include "sim/cube_camera.hpp"
#include "sim/cube_cell.hpp"
#include "tasks/rubik/cube/move.hpp"
#include "tasks/rubik/reading/state_reading.hpp"
#include "vsp/cube_face/cube_face_sensor.hpp"

namespace mrroc::bench {
namespace {

using rubik::FaceView;

enum class Lighting : std::uint8_t { white, coloured, dim, glaring };
constexpr int kLightings = 4;
constexpr int kCubes = 168;     // six faces each
constexpr int kMostAgain = 12;  // faces of one cube that are looked at again

/// The meeting place with the track arm's hand, the other arm 0.1 m away, and any face of any cube before the camera.
class ShownCube {
 public:
  explicit ShownCube(unsigned seed) : random_(seed), camera_(sim::cube_camera()) {
    sim::CubeCellParameters c;
    c.distance = 0.1;
    const sim::WorldParameters parameters = sim::cube_cell(c);
    const sim::World world(parameters, 1);
    truth_ = *world.cube();
    sim::WorldParameters without = parameters;
    without.cube.reset();
    scene_ = sim::CellScene(without).take(world);
    scene_.bodies.erase(scene_.bodies.end() - kCubeBodies, scene_.bodies.end());
  }

  [[nodiscard]] const CameraSetup& camera() const { return camera_; }
  [[nodiscard]] Pose place() const { return camera_.place.inverse() * sim::shown_place(); }

  /// @return a scene with the cube as it may lie in the hand, some millimetres and degrees from where it should
  camera::Scene show(const rubik::Cube& cube, rubik::ShownFace shown, Lighting lighting) {
    camera::Scene scene = scene_;
    light(scene, lighting);
    sim::CubeTruth truth = truth_;
    truth.state = cube;
    // The face's facelets as shown, upright in G.
    const Matrix3 R_GC = rotation_from_angle_axis({0, 0, -shown.quarters * std::numbers::pi / 2}) *
                         rubik::facelet_frame(shown.face).transpose();
    const Vector3 shift(uniform(-2e-3, 2e-3), uniform(-2e-3, 2e-3), uniform(-2e-3, 2e-3));
    const Vector3 turn(uniform(-0.02, 0.02), uniform(-0.02, 0.02), uniform(-0.02, 0.02));
    truth.T_UC = sim::meeting_place() * Pose{rotation_from_angle_axis(turn) * R_GC, shift};
    sim::add_cube(scene.bodies, truth);
    return scene;
  }

  int pick(int n) { return std::uniform_int_distribution<>(0, n - 1)(random_); }
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }

 private:
  static constexpr int kCubeBodies = 26 + rubik::kFacelets;

  void light(camera::Scene& scene, Lighting lighting) {
    camera::Light& light = scene.light;
    light.direction += Vector3(uniform(-0.5, 0.5), uniform(-0.5, 0.5), 0);
    light.exposure = uniform(0.7, 1.2);
    if (lighting == Lighting::dim) light.exposure = uniform(0.2, 0.4);
    if (lighting == Lighting::coloured) {
      const camera::Colour tint{std::exp(uniform(-0.4, 0.4)), 1, std::exp(uniform(-0.4, 0.4))};
      for (std::size_t c = 0; c < 3; ++c) light.lamp[c] *= tint[c], light.ambient[c] *= tint[c];
    }
    if (lighting != Lighting::glaring) return;
    // The lamp mirrors itself somewhere on the face, and nothing stands in its light.
    const Pose face = sim::shown_place();
    const Vector3 view =
        (camera_.place.p - face * Vector3(uniform(-0.03, 0.03), uniform(-0.03, 0.03), 0)).normalized();
    const Vector3 normal = face.R.col(2);
    light.direction = 2 * normal.dot(view) * normal - view;
    light.lamp.fill(uniform(0.8, 1.4));
    light.exposure = 0.6;
    for (camera::Body& body : scene.bodies) body.casts_shadow = false;
  }

  std::mt19937 random_;
  CameraSetup camera_;
  camera::Scene scene_;
  sim::CubeTruth truth_;
};

/// What became of the faces under one kind of light.
struct Tally {
  int faces{}, named_wrong{}, named_unsure{}, wrong{}, flagged{}, unread{}, completed{};
};

StickerColour colour_of(char letter) {
  return static_cast<StickerColour>(std::string_view("URFDLB").find(letter));
}

class FaceBench {
 public:
  FaceBench() : shown_(41), sensor_(shown_.camera().model, {shown_.place()}) {}

  void look_at_cube(int number, Lighting lighting, Tally& tally) {
    std::mt19937_64 random(static_cast<std::uint64_t>(number) + 1);
    const rubik::Cube cube = rubik::random_cube(random);
    const std::string facelets = rubik::to_facelets(cube);
    std::vector<FaceView> views;
    for (int f = 0; f < rubik::kFaces; ++f)
      views.push_back(look_at_face(cube, static_cast<rubik::Face>(f), lighting, facelets, tally));
    rubik::StateReading state = rubik::read_state(views);
    for (int again = 0; !state.cube && again < kMostAgain; ++again) {
      ++tally.flagged;
      views.push_back(look_at_face(cube, *state.reread, lighting, facelets, tally));
      state = rubik::read_state(views);
    }
    tally.completed += static_cast<int>(state.completed.size());
    if (!state.cube) {
      ++tally.unread;
      return;
    }
    for (int f = 0; f < rubik::kFaces; ++f) {
      const auto first = static_cast<std::size_t>(kStickers * f);
      if (state.facelets.substr(first, kStickers) != facelets.substr(first, kStickers)) ++tally.wrong;
    }
  }

  [[nodiscard]] double longest_ms() const { return longest_; }

 private:
  FaceView look_at_face(const rubik::Cube& cube, rubik::Face face, Lighting lighting,
                        const std::string& facelets, Tally& tally) {
    FaceView view;
    view.shown = {face, shown_.pick(4)};
    const Image picture =
        renderer_.render(shown_.show(cube, view.shown, lighting), shown_.camera().place, tally.faces++);
    const double begun = thread_ms();
    const CubeFaceReading reading = sensor_.detect(picture.view(), tally.faces, 0);
    longest_ = std::max(longest_, thread_ms() - begun);
    judge_names(reading, view.shown, facelets, tally);
    view.stickers = reading.stickers;
    if (!reading.seen)
      for (StickerReading& s : view.stickers) s.flaw = StickerFlaw::hidden;
    return view;
  }

  void judge_names(const CubeFaceReading& reading, rubik::ShownFace shown, const std::string& facelets,
                   Tally& tally) {
    if (!reading.valid) {
      ++tally.named_unsure;
      return;
    }
    bool wrong = false;
    for (int k = 0; k < kStickers; ++k)
      wrong = wrong || reading.stickers[static_cast<std::size_t>(k)].colour !=
                           colour_of(facelets[static_cast<std::size_t>(rubik::facelet(shown, k))]);
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
      {"cube_flagged", sum(&Tally::flagged), "", "faces of these that had to be looked at again"},
      {"cube_flagged_white", flagged(Lighting::white), "", "of them in white light"},
      {"cube_flagged_coloured", flagged(Lighting::coloured), "", "of them in coloured light"},
      {"cube_flagged_dim", flagged(Lighting::dim), "", "of them with 20 to 40 % of the light"},
      {"cube_flagged_glaring", flagged(Lighting::glaring), "", "of them with the lamp's image on the face"},
      {"cube_unread", sum(&Tally::unread), "",
       "cubes without a state after 12 faces had been looked at again"},
      {"cube_completed", sum(&Tally::completed), "", "stickers that the rules of the cube decided"},
      {"cube_face_pictures", sum(&Tally::faces), "", "pictures of faces, those looked at again included"},
      {"cube_face_misnamed", sum(&Tally::named_wrong), "",
       "valid readings of one picture that name a colour wrong"},
      {"cube_face_unsure", sum(&Tally::named_unsure), "", "readings of one picture that are not valid"},
      {"cube_face_ms_max", bench.longest_ms(), "ms", "processor time of the longest reading"},
  };
}

}  // namespace mrroc::bench
