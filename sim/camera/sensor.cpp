#include "sim/camera/sensor.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::camera {
namespace {

// Well mixed bits from neighbouring numbers (splitmix64, S. Vigna).
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}
constexpr std::uint64_t kStride = 0x9e3779b97f4a7c15;

constexpr int kQuantiles = 4096;
constexpr int kQuantileBits = 12;

/// Quantiles of the normal distribution in units of 2^-8: a uniform number in, a normal one out.
std::array<std::int32_t, kQuantiles> normal_quantiles() {
  std::array<std::int32_t, kQuantiles> table{};
  for (int k = 0; k < kQuantiles / 2; ++k) {
    const double share = (k + 0.5) / kQuantiles;
    double low = -6;
    double high = 0;
    for (int bit = 0; bit < 40; ++bit) {
      const double middle = (low + high) / 2;
      (std::erfc(-middle / std::sqrt(2.0)) / 2 < share ? low : high) = middle;
    }
    const auto value = static_cast<std::int32_t>(std::lround(low * 256));
    table[static_cast<std::size_t>(k)] = value;
    table[static_cast<std::size_t>(kQuantiles - 1 - k)] = -value;
  }
  return table;
}
const std::array<std::int32_t, kQuantiles> kNormal = normal_quantiles();

std::vector<std::uint16_t> gaussian(double sigma) {
  if (!(sigma > 0)) return {};
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  std::vector<double> weights;
  double sum = 0;
  for (int k = 0; k <= radius; ++k) {
    weights.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
    sum += (k == 0 ? 1 : 2) * weights.back();
  }
  std::vector<std::uint16_t> kernel;
  int rest = 256;
  for (int k = 0; k <= radius; ++k) {
    kernel.push_back(
        static_cast<std::uint16_t>(std::lround(256 * weights[static_cast<std::size_t>(k)] / sum)));
    rest -= (k == 0 ? 1 : 2) * kernel.back();
  }
  kernel[0] = static_cast<std::uint16_t>(kernel[0] + rest);
  return kernel;
}

/// Blurs `count` pixels that lie `stride` words apart.
void blur_line(const std::uint32_t* in, std::uint32_t* out, int count, std::ptrdiff_t stride,
               std::span<const std::uint16_t> kernel) {
  const auto channels = [&](int k) {  // three channels in 16 bits each
    const std::uint64_t p = in[std::clamp(k, 0, count - 1) * stride];
    return (p & 0xff) | (p & 0xff00) << 8 | (p & 0xff0000) << 16;
  };
  for (int k = 0; k < count; ++k) {
    std::uint64_t sum = kernel[0] * channels(k) + 0x008000800080;
    for (int r = 1; r < static_cast<int>(kernel.size()); ++r)
      sum += kernel[static_cast<std::size_t>(r)] * (channels(k - r) + channels(k + r));
    out[k * stride] =
        static_cast<std::uint32_t>((sum >> 8 & 0xff) | (sum >> 16 & 0xff00) | (sum >> 24 & 0xff0000));
  }
}

}  // namespace

Sensor::Sensor(int width, int height, int channels, double noise, double defocus, std::uint64_t seed)
    : width_(width),
      height_(height),
      channels_(channels),
      seed_(mixed(seed + kStride)),
      noise_(noise > 0),
      kernel_(gaussian(defocus)) {
  // What the electronics add is the same everywhere; the variance of the light's own noise grows with the light.
  for (int grey = 0; grey < 256; ++grey)
    deviation_[static_cast<std::size_t>(grey)] =
        static_cast<std::int32_t>(std::lround(256 * noise * std::sqrt(0.4 + 0.6 * grey / 127.5)));
}

std::uint8_t Sensor::noisy(std::uint32_t grey, std::uint64_t random) const {
  const std::int32_t normal = kNormal[random & (kQuantiles - 1)];
  const std::int32_t change = (normal * deviation_[grey] + (1 << 15)) >> 16;
  return static_cast<std::uint8_t>(std::clamp(static_cast<std::int32_t>(grey) + change, 0, 255));
}

void Sensor::blur(std::span<std::uint32_t> light) {
  scratch_.resize(light.size());
  for (int y = 0; y < height_; ++y)
    blur_line(light.data() + y * width_, scratch_.data() + y * width_, width_, 1, kernel_);
  for (int x = 0; x < width_; ++x) blur_line(scratch_.data() + x, light.data() + x, height_, width_, kernel_);
}

Image Sensor::take(std::span<std::uint32_t> light, std::int64_t frame) {
  if (!kernel_.empty()) blur(light);
  Image image(width_, height_, channels_);
  std::uint8_t* out = image.data.data();
  std::uint64_t random = mixed(seed_ + static_cast<std::uint64_t>(frame) * kStride);
  for (const std::uint32_t p : light) {
    const std::uint32_t blue = p & 0xff;
    const std::uint32_t green = p >> 8 & 0xff;
    const std::uint32_t red = p >> 16 & 0xff;
    const std::uint64_t bits = noise_ ? mixed(random += kStride) : 0;
    const auto put = [&](std::uint32_t grey, int place) {
      *out++ = noise_ ? noisy(grey, bits >> (place * kQuantileBits)) : static_cast<std::uint8_t>(grey);
    };
    if (channels_ == 1) {
      put((29 * blue + 150 * green + 77 * red + 128) >> 8, 0);
    } else {
      put(blue, 0);
      put(green, 1);
      put(red, 2);
    }
  }
  return image;
}

}  // namespace mrroc::camera
