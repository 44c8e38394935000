#include <algorithm>
#include <cmath>

#include "vsp/cube_face/sticker_colour.hpp"

namespace mrroc::vsp {
namespace {

using Rgb = std::array<double, 3>;

// Reflectance of stickers of the usual colours, in the order of StickerColour.
constexpr std::array<Rgb, kStickerColours> kPalette{{{0.86, 0.86, 0.84},
                                                     {0.70, 0.06, 0.07},
                                                     {0.05, 0.50, 0.18},
                                                     {0.84, 0.74, 0.07},
                                                     {0.92, 0.36, 0.06},
                                                     {0.05, 0.20, 0.60}}};
constexpr double kLikeness = 0.15;  // of stickers of one name, standard deviation of the ratios
constexpr double kTint = 0.25;      // of lamps, likewise
constexpr double kTintStep = 0.075;
constexpr int kTintSteps = 10;     // to either side
constexpr double kStrange = 1e-4;  // density of colours without a name

/// One sticker against all names.
class Evidence {
 public:
  explicit Evidence(const StickerReading& s) : measured_(tint(s.rgb)), variance_(s.tint_variance()) {
    sum_ = s.rgb[0] + s.rgb[1] + s.rgb[2];
    for (double& v : variance_) v += kLikeness * kLikeness;
  }

  /// @param lamp  its red, green and blue @return density of what was measured for each name
  [[nodiscard]] std::array<double, kStickerColours> densities(const Rgb& lamp) const {
    std::array<double, kStickerColours> all{};
    for (std::size_t name = 0; name < kStickerColours; ++name) {
      Rgb expected;
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c) sum += expected[c] = lamp[c] * kPalette[name][c];
      for (double& x : expected) x *= sum_ / sum;  // as bright as the sticker
      const auto r = tint(expected);
      double square = 0;
      for (std::size_t k = 0; k < 2; ++k)
        square += (r[k] - measured_[k]) * (r[k] - measured_[k]) / variance_[k];
      all[name] = std::exp(-square / 2);
    }
    return all;
  }

 private:
  std::array<double, 2> measured_;
  std::array<double, 2> variance_;
  double sum_{};
};

}  // namespace

void name_colours(std::array<StickerReading, kStickers>& stickers) {
  std::array<std::array<double, kStickerColours>, kStickers> probability{};
  double total = 0;
  std::vector<std::size_t> good;
  std::vector<Evidence> evidence;
  for (std::size_t k = 0; k < kStickers; ++k)
    if (stickers[k].flaw == StickerFlaw::none) good.push_back(k), evidence.emplace_back(stickers[k]);
  for (int i = -kTintSteps; i <= kTintSteps; ++i)
    for (int j = -kTintSteps; j <= kTintSteps; ++j) {
      const double red = kTintStep * i;
      const double blue = kTintStep * j;
      double likelihood = std::exp(-(red * red + blue * blue) / (2 * kTint * kTint));
      std::array<std::array<double, kStickerColours>, kStickers> share{};
      for (std::size_t n = 0; n < good.size(); ++n) {
        share[n] = evidence[n].densities({std::exp(red), 1, std::exp(blue)});
        double sum = kStrange;
        for (const double d : share[n]) sum += d;
        for (double& d : share[n]) d /= sum;
        likelihood *= sum;
      }
      total += likelihood;
      for (std::size_t n = 0; n < good.size(); ++n)
        for (std::size_t name = 0; name < kStickerColours; ++name)
          probability[n][name] += likelihood * share[n][name];
    }
  if (!(total > 0)) return;
  for (std::size_t n = 0; n < good.size(); ++n) {
    const auto best = std::ranges::max_element(probability[n]);
    stickers[good[n]].colour = static_cast<StickerColour>(best - probability[n].begin());
    stickers[good[n]].confidence = *best / total;
  }
}

}  // namespace mrroc::vsp
