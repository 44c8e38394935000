// Renders a scene as a camera with a real lens and a noisy sensor sees it. Drawn by OpenGL in memory, without
// display and graphics card; docs/decisions.md tells why no library is used.
#pragma once
#include <cstdint>
#include <memory>
#include <span>

#include "base/camera.hpp"
#include "base/image.hpp"
#include "sim/camera/scene.hpp"

namespace mrroc::camera {

/// Effort for a picture.
struct RenderProfile {
  int samples{4};             ///< per pixel, 1..4: smooth edges
  int shadow_size{1024};      ///< edge of the shadows' map [texel]; 0: neither shadows nor highlights
  bool textures_sharp{true};  ///< pictures on bodies stay sharp when seen at a slant (anisotropic filter)
  int channels{3};            ///< 3: blue, green, red; 1: grey
  double noise{2};    ///< standard deviation in half-bright pixels [grey values]; less in dark ones; 0: none
  double defocus{0};  ///< standard deviation of the blur by the lens [pixel], 0..10
  std::uint64_t seed{1};  ///< of the noise
};

/// @return for tests and figures: smooth edges, shadows
RenderProfile exact_profile();
/// @return for watching: no smooth edges, shadows, highlights
RenderProfile fast_profile();
/// @return the quickest, for odometry: neither smooth edges nor shadows, pictures on bodies as far as they stay sharp
RenderProfile plain_profile();

/// One instant of an exposure.
struct Instant {
  Scene scene;  ///< everything that can be seen
  Pose T_UC;    ///< the camera C in the world U
};

/// Draws what one camera sees. Not for the servo step; moves between threads, used by one at a time.
///
/// A point in front of the camera appears where project() tells (base/camera.hpp): corners of a board to within 0.05
/// pixel rms, the lens's distortion included. Equal arguments give equal bytes: in every thread, beside any number of
/// other renderers, in any order of frames.
class Renderer {
 public:
  /// @throws FaultError no_renderer; std::invalid_argument  a parameter is out of range, or the lens bends so much
  ///         that some pixels see nothing
  Renderer(const CameraModel& camera, const RenderProfile& profile);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// @param T_UC   camera in the world
  /// @param frame  its number: decides the noise
  /// @return a picture of the camera's size; only what is 0.02 to 10 m in front of the camera is seen
  Image render(const Scene& scene, const Pose& T_UC, std::int64_t frame);

  /// The mean over an exposure: what moves is blurred. @param exposure  one instant or more
  Image render(std::span<const Instant> exposure, std::int64_t frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrroc::camera
