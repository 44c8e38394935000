// The sensor behind the lens: adds blur and noise, and makes the bytes of the picture.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/image.hpp"

namespace mrroc::camera {

/// Makes a picture of the light. A pixel of light is a word: blue in its lowest byte, then green, then red.
class Sensor {
 public:
  /// Parameters as in RenderProfile.
  Sensor(int width, int height, int channels, double noise, double defocus, std::uint64_t seed);

  /// @param light  width * height pixels; used up
  /// @param frame  with the seed and the pixel's place it decides the noise
  [[nodiscard]] Image take(std::span<std::uint32_t> light, std::int64_t frame);

 private:
  void blur(std::span<std::uint32_t> light);
  [[nodiscard]] std::uint8_t noisy(std::uint32_t grey, std::uint64_t random) const;

  int width_, height_, channels_;
  std::uint64_t seed_;
  std::array<std::int32_t, 256> deviation_{};  // of a grey value, in units of 2^-8
  bool noise_{};
  std::vector<std::uint16_t> kernel_;  // from the middle outwards, both sides together sum up to 256
  std::vector<std::uint32_t> scratch_;
};

}  // namespace mrroc::camera
