#include "vsp/chessboard/chain.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace mrroc::vsp::chessboard {
namespace {

constexpr double kLeastArea = 9;       // of a dark square after dilation [pixel^2]
constexpr float kDilationLoss = 1.2F;  // by which dilation and approximation move a corner inwards [pixel]
constexpr double kTolerances[]{0.05, 0.09, 0.13};  // of the approximation, in perimeters

// Four corners in the plane, or nothing when the outline is no quadrangle.
bool approximate(const std::vector<cv::Point>& contour, double perimeter, std::vector<cv::Point>& corners) {
  for (const double tolerance : kTolerances) {
    cv::approxPolyDP(contour, corners, tolerance * perimeter, true);
    if (corners.size() == 4) return cv::isContourConvex(corners);
    if (corners.size() < 4) return false;
  }
  return false;
}

Quadrangle grown(const std::vector<cv::Point>& corners) {
  Quadrangle q;
  cv::Point2f centre(0, 0);
  for (const cv::Point& c : corners) centre += 0.25F * cv::Point2f(c);
  q.centre = centre;
  // From the outline of a region's pixels; clockwise in the picture is a positive area with y downwards.
  const cv::Point a = corners[1] - corners[0];
  const cv::Point b = corners[2] - corners[1];
  const bool clockwise = a.cross(b) > 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const cv::Point2f c = corners[clockwise ? k : 3 - k];
    const cv::Point2f out = c - centre;
    q.corner[k] = c + out * (kDilationLoss * 1.4F / std::max(1.0F, static_cast<float>(cv::norm(out))));
  }
  q.shortest = std::numeric_limits<float>::max();
  for (std::size_t k = 0; k < 4; ++k)
    q.shortest = std::min(q.shortest, static_cast<float>(cv::norm(q.corner[k] - q.corner[(k + 1) % 4])));
  return q;
}

bool is_square_like(const Quadrangle& q) {
  float longest = 0;
  for (std::size_t k = 0; k < 4; ++k)
    longest = std::max(longest, static_cast<float>(cv::norm(q.corner[k] - q.corner[(k + 1) % 4])));
  return longest < 4 * q.shortest;
}

struct Corner {
  std::size_t quadrangle{};
  std::size_t k{};
};

// Corners sorted into squares of the picture, so that near ones are found without comparing all.
class NearCorners {
 public:
  explicit NearCorners(const std::vector<Quadrangle>& all) {
    for (const Quadrangle& q : all)
      for (const cv::Point2f& c : q.corner) {
        columns_ = std::max(columns_, bin(c.x) + 1);
        rows_ = std::max(rows_, bin(c.y) + 1);
      }
    bins_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (std::size_t n = 0; n < all.size(); ++n)
      for (std::size_t k = 0; k < 4; ++k) {
        auto& bin_of = bins_[index(bin(all[n].corner[k].x), bin(all[n].corner[k].y))];
        if (bin_of.size() < kCrowd) bin_of.push_back({n, k});
      }
  }

  // Calls see(corner) for all that are not farther than the radius, and some others.
  template <class See>
  void around(const cv::Point2f& p, float radius, See see) const {
    for (int y = std::max(0, bin(p.y - radius)); y <= std::min(rows_ - 1, bin(p.y + radius)); ++y)
      for (int x = std::max(0, bin(p.x - radius)); x <= std::min(columns_ - 1, bin(p.x + radius)); ++x)
        for (const Corner& c : bins_[index(x, y)]) see(c);
  }

 private:
  static constexpr float kBin = 16;          // [pixel]
  static constexpr std::size_t kCrowd = 40;  // no board has more corners in so small a place
  static int bin(float x) { return static_cast<int>(std::max(0.0F, x) / kBin); }
  [[nodiscard]] std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * columns_ + x); }

  int columns_{1};
  int rows_{1};
  std::vector<std::vector<Corner>> bins_;
};

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
using Neighbours = std::vector<std::array<Corner, 4>>;

// For every corner the nearest corner of a fitting quadrangle on its other side.
Neighbours nearest_neighbours(const std::vector<Quadrangle>& all) {
  Neighbours nearest(all.size(), {Corner{kNone, 0}, Corner{kNone, 0}, Corner{kNone, 0}, Corner{kNone, 0}});
  const NearCorners near(all);
  for (std::size_t n = 0; n < all.size(); ++n)
    for (std::size_t k = 0; k < 4; ++k) {
      const cv::Point2f c = all[n].corner[k];
      float best = 0.5F * all[n].shortest;
      near.around(c, best, [&](const Corner& other) {
        if (other.quadrangle == n) return;
        const Quadrangle& q = all[other.quadrangle];
        const auto distance = static_cast<float>(cv::norm(c - q.corner[other.k]));
        if (distance >= best || q.shortest > 3 * all[n].shortest || all[n].shortest > 3 * q.shortest) return;
        const cv::Point2f to_own = all[n].centre - c;
        const cv::Point2f to_other = q.centre - q.corner[other.k];
        if (to_own.dot(to_other) > -0.3F * static_cast<float>(cv::norm(to_own) * cv::norm(to_other))) return;
        best = distance;
        nearest[n][k] = other;
      });
    }
  return nearest;
}

bool mutual(const Neighbours& nearest, std::size_t n, std::size_t k) {
  const Corner other = nearest[n][k];
  if (other.quadrangle == kNone) return false;
  const Corner back = nearest[other.quadrangle][other.k];
  return back.quadrangle == n && back.k == k;
}

}  // namespace

cv::Mat threshold(const cv::Mat& grey, int block, int offset) {
  cv::Mat binary;
  cv::adaptiveThreshold(grey, binary, 255, cv::ADAPTIVE_THRESH_MEAN_C, cv::THRESH_BINARY, block, offset);
  return binary;
}

cv::Mat dilation(const cv::Mat& binary) {
  cv::Mat grown_light;
  cv::dilate(binary, grown_light, cv::Mat());
  return grown_light;
}

std::vector<std::vector<cv::Point>> contours(const cv::Mat& binary, const WorkLimits& limits) {
  cv::Mat dark;
  cv::bitwise_not(binary, dark);
  std::vector<std::vector<cv::Point>> all;
  std::vector<cv::Vec4i> hierarchy;
  cv::findContours(dark, all, hierarchy, cv::RETR_CCOMP, cv::CHAIN_APPROX_SIMPLE);
  std::vector<std::vector<cv::Point>> outer;
  for (std::size_t k = 0; k < all.size() && outer.size() < limits.contours; ++k)
    if (hierarchy[k][3] < 0 && all[k].size() >= 4) outer.push_back(std::move(all[k]));
  return outer;
}

std::vector<Quadrangle> quadrangles(const std::vector<std::vector<cv::Point>>& contours,
                                    const WorkLimits& limits) {
  std::vector<Quadrangle> found;
  std::vector<cv::Point> corners;
  for (const auto& contour : contours) {
    if (found.size() >= limits.quadrangles) break;
    const double area = cv::contourArea(contour);
    if (area < kLeastArea) continue;
    const double perimeter = cv::arcLength(contour, true);
    if (area < 0.02 * perimeter * perimeter) continue;  // a square has 1/16, one seen at 75 degrees 0.04
    if (!approximate(contour, perimeter, corners)) continue;
    if (std::abs(cv::contourArea(corners)) < 0.6 * area) continue;
    const Quadrangle q = grown(corners);
    if (is_square_like(q)) found.push_back(q);
  }
  return found;
}

std::vector<Lattice> lattices(const std::vector<Quadrangle>& quadrangles) {
  constexpr std::size_t kLeast = 3;
  const Neighbours nearest = nearest_neighbours(quadrangles);
  std::vector<char> taken(quadrangles.size(), 0);
  std::vector<Lattice> found;
  for (std::size_t seed = 0; seed < quadrangles.size(); ++seed) {
    if (taken[seed] != 0) continue;
    Lattice lattice{{seed, 0, 0, 0}};
    taken[seed] = 1;
    for (std::size_t next = 0; next < lattice.size(); ++next) {
      const Cell cell = lattice[next];
      for (int k = 0; k < 4; ++k) {
        if (!mutual(nearest, cell.quadrangle, static_cast<std::size_t>(k))) continue;
        const Corner other = nearest[cell.quadrangle][static_cast<std::size_t>(k)];
        if (taken[other.quadrangle] != 0) continue;
        taken[other.quadrangle] = 1;
        const int at = (k + cell.turn) % 4;
        const int di = at == 1 || at == 2 ? 1 : -1;
        const int dj = at >= 2 ? 1 : -1;
        const int turn = (at + 2 - static_cast<int>(other.k) + 4) % 4;
        lattice.push_back({other.quadrangle, cell.i + di, cell.j + dj, turn});
      }
    }
    if (lattice.size() >= kLeast) found.push_back(std::move(lattice));
  }
  std::ranges::stable_sort(found, std::ranges::greater{}, &Lattice::size);
  return found;
}

}  // namespace mrroc::vsp::chessboard
