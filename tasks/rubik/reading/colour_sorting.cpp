#include "tasks/rubik/reading/colour_sorting.hpp"

#include <algorithm>
#include <limits>

#include "tasks/rubik/reading/assignment.hpp"

namespace mrroc::rubik {
namespace {

using Tint = Eigen::Array2d;

constexpr int kRounds = 4;
constexpr double kFarthest =
    100;  // bound of a distance: one strange sticker must not move the others [variances]
constexpr int kOthers = kStickers - 1;

constexpr bool is_centre(int facelet) { return facelet % kStickers == kStickers / 2; }
constexpr int centre_of(int face) { return kStickers * face + kStickers / 2; }

struct Sample {
  bool known{};
  Tint tint{0, 0};
  Tint variance{1, 1};
};

class Sorter {
 public:
  Sorter(const std::array<StickerReading, kFacelets>& stickers, const ColourSortingParameters& k) : k_(k) {
    for (std::size_t f = 0; f < kFacelets; ++f) {
      samples_[f].known = stickers[f].flaw == StickerFlaw::none;
      const auto t = tint(stickers[f].rgb);
      const auto v = stickers[f].tint_variance();
      samples_[f].tint = Tint(t[0], t[1]);
      samples_[f].variance = Tint(v[0], v[1]) + k.least_deviation * k.least_deviation;
    }
    for (int face = 0; face < kFaces; ++face) colours_[at(face)] = samples_[at(centre_of(face))].tint;
  }

  SortedColours sort() {
    for (int round = 0; round < kRounds; ++round) {
      measure();
      assign();
      if (round + 1 < kRounds) take_means();
    }
    weigh_exchanges();
    return result_;
  }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  void measure() {
    for (std::size_t f = 0; f < kFacelets; ++f)
      for (std::size_t face = 0; face < kFaces; ++face)
        result_.distance[f][face] =
            samples_[f].known
                ? std::min(kFarthest,
                           ((samples_[f].tint - colours_[face]).square() / samples_[f].variance).sum())
                : 0;
  }

  void assign() {
    std::vector<int> facelets;
    for (int f = 0; f < kFacelets; ++f)
      if (is_centre(f))
        result_.face[at(f)] = f / kStickers;
      else
        facelets.push_back(f);
    const auto n = static_cast<Eigen::Index>(facelets.size());
    Eigen::MatrixXd cost(n, n);
    for (Eigen::Index row = 0; row < n; ++row)
      for (Eigen::Index column = 0; column < n; ++column)
        cost(row, column) = result_.distance[at(facelets[static_cast<std::size_t>(row)])]
                                            [static_cast<std::size_t>(column / kOthers)];
    const std::vector<int> columns = least_cost_assignment(cost);
    for (std::size_t k = 0; k < facelets.size(); ++k) result_.face[at(facelets[k])] = columns[k] / kOthers;
  }

  void take_means() {
    for (int face = 0; face < kFaces; ++face) {
      Tint sum(0, 0);
      Tint weights(0, 0);
      for (std::size_t f = 0; f < kFacelets; ++f) {
        if (!samples_[f].known || result_.face[f] != face || result_.distance[f][at(face)] > k_.strange)
          continue;
        sum += samples_[f].tint / samples_[f].variance;
        weights += samples_[f].variance.inverse();
      }
      if (weights.minCoeff() > 0) colours_[at(face)] = sum / weights;
    }
  }

  void weigh_exchanges() {
    for (std::size_t i = 0; i < kFacelets; ++i) {
      const std::size_t own = at(result_.face[i]);
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < kFacelets; ++j) {
        const std::size_t other = at(result_.face[j]);
        if (other == own || is_centre(static_cast<int>(j))) continue;
        least = std::min(least, result_.distance[i][other] - result_.distance[i][own] +
                                    result_.distance[j][own] - result_.distance[j][other]);
      }
      result_.exchange[i] = samples_[i].known ? std::max(0.0, least) : 0;
      result_.strange[i] = result_.distance[i][own] > k_.strange;
    }
    result_.centres = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < kFaces; ++a)
      for (std::size_t b = 0; b < a; ++b)
        result_.centres = std::min(result_.centres, (colours_[a] - colours_[b]).square().sum() /
                                                        (k_.least_deviation * k_.least_deviation));
  }

  ColourSortingParameters k_;
  std::array<Sample, kFacelets> samples_;
  std::array<Tint, kFaces> colours_;
  SortedColours result_;
};

}  // namespace

SortedColours sort_colours(const std::array<StickerReading, kFacelets>& stickers,
                           const ColourSortingParameters& parameters) {
  return Sorter(stickers, parameters).sort();
}

}  // namespace mrroc::rubik
