// The lens: the direction from which the light of each pixel comes.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/camera.hpp"

namespace mrroc::camera {

/// Inverse of project(). @return point at z = 1 that is seen at the pixel
/// @throws std::invalid_argument  no point is seen there
Vector2 unproject(const CameraModel& camera, const Vector2& pixel);

/// Bends the picture of a pinhole camera into that of a camera with a lens.
class Lens {
 public:
  /// @throws std::invalid_argument  the lens bends so much that a pixel sees nothing, or needs a pinhole picture of
  ///         more than four times the size
  explicit Lens(const CameraModel& camera);

  /// @return the camera without distortion, and with all that the pixels of the real one see; the same camera when
  ///         that has no distortion
  [[nodiscard]] const CameraModel& pinhole() const { return pinhole_; }

  /// @param seen  picture of the pinhole camera, a pixel per word
  /// @param bent  receives that of the camera; may be `seen` itself when there is no distortion
  void bend(std::span<const std::uint32_t> seen, std::span<std::uint32_t> bent) const;

 private:
  struct Source {
    std::uint32_t offset;      // of the upper left one of four pixels
    std::uint8_t right, down;  // share of the right and of the lower ones [1/256]
  };
  CameraModel pinhole_;
  std::vector<Source> sources_;  // one per pixel; empty: no distortion
};

}  // namespace mrroc::camera
