#include "bench/vision_render.hpp"

#include <ctime>

#include "base/camera_config.hpp"
#include "sim/camera/cell_scene.hpp"
#include "sim/camera/renderer.hpp"
#include "sim/camera/textures.hpp"
#include "test/rig/irb6_cell.hpp"

namespace mrroc::bench {
namespace {

/// Of all threads: what else the machine does does not count.
double processor_ms() {
  std::timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * (static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec));
}

double render_ms(const camera::RenderProfile& profile) {
  const sim::WorldParameters parameters = rig::irb6_cell();
  const sim::World world(parameters, 1);
  camera::Scene scene = sim::CellScene(parameters).take(world);
  const Pose& T_UB = parameters.arms[0].T_UB;
  camera::add_board(scene, {}, T_UB * Pose{Matrix3::Identity(), {1.0, 0.15, 0.93}});
  CameraModel model;
  model.distortion = {-0.1, 0.01, 0, 0, 0};
  camera::Renderer renderer(model, profile);
  constexpr int kPictures = 30;
  double begun = 0;
  for (int k = -3; k < kPictures; ++k) {
    if (k == 0) begun = processor_ms();  // the first ones compile the shaders
    const Vector3 eye(1.1, -0.1 + 0.01 * k, 2.4);
    renderer.render(scene, T_UB * looking_at(eye, {0.95, 0, 0.93}, {1, 0, 0}), k);
  }
  return (processor_ms() - begun) / kPictures;
}

}  // namespace

Figures run_render_figures() {
  return {{"render_ms", render_ms(camera::exact_profile()), "ms",
           "processor time of a picture, 640x480, lens, noise, shadows, smooth edges"},
          {"render_fast_ms", render_ms(camera::fast_profile()), "ms",
           "the same without shadows and smooth edges"}};
}

}  // namespace mrroc::bench
