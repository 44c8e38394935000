#include "sim/camera/renderer.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "sim/camera/lens.hpp"
#include "sim/camera/painter.hpp"
#include "sim/camera/sensor.hpp"

namespace mrroc::camera {
namespace {

constexpr int kLargestPicture = 4096;  // [pixel] along an edge
constexpr std::size_t kMostInstants = 256;

const CameraModel& checked(const CameraModel& camera, const RenderProfile& p) {
  const auto refuse = [](const char* what) { throw std::invalid_argument(std::string("camera: ") + what); };
  if (!is_proper(camera)) refuse("a number of its model is not finite or not positive");
  if (camera.width > kLargestPicture || camera.height > kLargestPicture) refuse("the picture is too large");
  if (p.samples < 1 || p.samples > 4) refuse("samples must be 1 to 4");
  if (p.shadow_size < 0 || p.shadow_size > kLargestPicture) refuse("shadow_size must be 0 to 4096");
  if (p.channels != 1 && p.channels != 3) refuse("channels must be 1 or 3");
  if (!(p.noise >= 0 && p.noise <= 100)) refuse("noise must be 0 to 100");
  if (!(p.defocus >= 0 && p.defocus <= 10)) refuse("defocus must be 0 to 10");
  return camera;
}

}  // namespace

RenderProfile exact_profile() { return {}; }

RenderProfile fast_profile() {
  RenderProfile p;
  p.samples = 1;
  p.shadow_size = 0;
  return p;
}

RenderProfile plain_profile() {
  RenderProfile p = fast_profile();
  p.textures_sharp = false;
  return p;
}

struct Renderer::Impl {
  Impl(const CameraModel& camera, const RenderProfile& p)
      : lens(checked(camera, p)),
        painter(lens.pinhole(), {p.samples, p.shadow_size, p.textures_sharp}),
        sensor(camera.width, camera.height, p.channels, p.noise, p.defocus, p.seed),
        seen(static_cast<std::size_t>(lens.pinhole().width * lens.pinhole().height)),
        light(static_cast<std::size_t>(camera.width * camera.height)) {}

  Image take(std::int64_t frame) {
    lens.bend(seen, light);
    return sensor.take(light, frame);
  }

  void add_to_sums() {
    sums.resize(3 * seen.size());
    for (std::size_t k = 0; k < seen.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c)
        sums[3 * k + c] = static_cast<std::uint16_t>(sums[3 * k + c] + (seen[k] >> (8 * c) & 0xff));
  }

  void take_mean(std::uint32_t count) {
    for (std::size_t k = 0; k < seen.size(); ++k) {
      seen[k] = 0;
      for (std::size_t c = 0; c < 3; ++c) seen[k] |= (sums[3 * k + c] + count / 2) / count << (8 * c);
    }
  }

  Lens lens;
  Painter painter;
  Sensor sensor;
  std::vector<std::uint32_t> seen;   // by the pinhole camera
  std::vector<std::uint32_t> light;  // behind the lens
  std::vector<std::uint16_t> sums;   // of an exposure, three per pixel
};

Renderer::Renderer(const CameraModel& camera, const RenderProfile& profile)
    : impl_(std::make_unique<Impl>(camera, profile)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Image Renderer::render(const Scene& scene, const Pose& T_UC, std::int64_t frame) {
  impl_->painter.paint(scene, T_UC, impl_->seen);
  return impl_->take(frame);
}

Image Renderer::render(std::span<const Instant> exposure, std::int64_t frame) {
  if (exposure.empty() || exposure.size() > kMostInstants)
    throw std::invalid_argument("camera: an exposure has 1 to 256 instants");
  if (exposure.size() == 1) return render(exposure[0].scene, exposure[0].T_UC, frame);
  impl_->sums.clear();
  for (const Instant& instant : exposure) {
    impl_->painter.paint(instant.scene, instant.T_UC, impl_->seen);
    impl_->add_to_sums();
  }
  impl_->take_mean(static_cast<std::uint32_t>(exposure.size()));
  return impl_->take(frame);
}

}  // namespace mrroc::camera
