#include "base/cube/cube_face.hpp"

#include <cmath>

namespace mrroc {

std::string_view to_string(StickerColour colour) {
  static constexpr std::array<std::string_view, kStickerColours> kNames{"white",  "red",    "green",
                                                                        "yellow", "orange", "blue"};
  return kNames[static_cast<std::size_t>(colour)];
}

namespace {

/// Grey that is added to all channels.
double added(const std::array<double, 3>& rgb) {
  constexpr double kShare = 0.03;
  return 1 + kShare * (rgb[0] + rgb[1] + rgb[2]);
}

}  // namespace

std::array<double, 2> tint(const std::array<double, 3>& rgb) {
  const double grey = added(rgb);
  return {std::log((rgb[0] + grey) / (rgb[1] + grey)), std::log((rgb[2] + grey) / (rgb[1] + grey))};
}

std::array<double, 2> StickerReading::tint_variance() const {
  constexpr double kLampTint = 0.1;  // variance of a lamp's colour
  const double grey = added(rgb);
  const auto variance = [&](double channel) {
    const double one = deviation / (channel + grey);
    const double other = deviation / (rgb[1] + grey);
    return (one - other) * (one - other) + kLampTint * (one * one + other * other);
  };
  return {variance(rgb[0]), variance(rgb[2])};
}

std::string_view to_string(StickerFlaw flaw) {
  static constexpr std::array<std::string_view, 5> kNames{"none", "hidden", "glaring", "dark", "mixed"};
  return kNames[static_cast<std::size_t>(flaw)];
}

}  // namespace mrroc
