#include "vsp/apriltag/border.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace mrroc::vsp {
namespace {

constexpr double kCell = 0.125;      // of the border's edge: it is dark inside and light outside for that far
constexpr double kLongestReach = 3;  // of a line across to either side [pixel]
constexpr double kStep = 0.5;        // between points on such a line [pixel]
constexpr double kEnds = 0.12;  // of the edge that are left out at either end, where the corners are blurred
constexpr double kLeastContrast = 12;
constexpr double kAlike = 0.6;       // contrast of the faintest edge to that of the strongest
constexpr double kUneven = 0.35;     // of the contrast along an edge
constexpr int kRounds = 3;           // of leaving out points that lie off
constexpr double kLeastShare = 0.7;  // of the lines across that must agree

// n . p = d
struct Line {
  Vector2 n;
  double d{};
  double sigma{};
  double contrast{};
};

struct Crossing {
  Vector2 p;
  double contrast{};
};

class Edge {
 public:
  Edge(const cv::Mat& grey, const Vector2& from, const Vector2& to, const Vector2& middle)
      : from_(from), along_(to - from) {
    out_ = Vector2(along_.y(), -along_.x()).normalized();
    if (out_.dot(from - middle) < 0) out_ = -out_;
    reach_ = std::min(kLongestReach, 0.6 * kCell * along_.norm());
    points_ = 2 * static_cast<int>(reach_ / kStep) + 1;
    lines_ = std::clamp(static_cast<int>((1 - 2 * kEnds) * along_.norm()), 8, 150);
    std::vector<cv::Point2f> places;
    for (int n = 0; n < lines_; ++n)
      for (int k = 0; k < points_; ++k) {
        const Vector2 p = foot(n) + way(k) * out_;
        places.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
      }
    cv::remap(grey, values_, places, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }

  [[nodiscard]] std::optional<Line> line() const {
    std::vector<Crossing> crossings = even_ones();
    for (int round = 1;; ++round) {
      if (static_cast<double>(crossings.size()) < kLeastShare * lines_) return std::nullopt;
      Line fit = through(crossings);
      std::vector<double> off;
      for (const Crossing& c : crossings) off.push_back(std::abs(fit.n.dot(c.p) - fit.d));
      const double limit = std::max(0.05, 4 * middle_of(off));
      std::vector<Crossing> near;
      double squares = 0;
      for (std::size_t k = 0; k < crossings.size(); ++k)
        if (off[k] < limit) {
          near.push_back(crossings[k]);
          squares += off[k] * off[k];
        }
      if (near.size() == crossings.size() || round == kRounds) {
        // Of the line at its ends, where it is twice as uncertain as in the middle.
        fit.sigma = 2 * std::sqrt(squares) / static_cast<double>(near.size());
        for (const Crossing& c : near) fit.contrast += c.contrast / static_cast<double>(near.size());
        return fit;
      }
      crossings = std::move(near);
    }
  }

  // From the steepest place of the mean over all lines across.
  [[nodiscard]] double blur() const {
    std::vector<double> mean(static_cast<std::size_t>(points_), 0);
    for (int n = 0; n < lines_; ++n)
      for (int k = 0; k < points_; ++k) mean[static_cast<std::size_t>(k)] += at(n, k) / lines_;
    double steepest = 0;
    for (std::size_t k = 2; k < mean.size(); ++k)
      steepest = std::max(steepest, (mean[k] - mean[k - 2]) / (2 * kStep));
    if (steepest <= 0) return std::numeric_limits<double>::infinity();
    return (mean.back() - mean.front()) / (std::sqrt(2 * std::numbers::pi) * steepest);
  }

 private:
  [[nodiscard]] Vector2 foot(int n) const {
    return from_ + (kEnds + (1 - 2 * kEnds) * (n + 0.5) / lines_) * along_;
  }
  [[nodiscard]] double way(int k) const { return k * kStep - 0.5 * (points_ - 1) * kStep; }
  [[nodiscard]] double at(int n, int k) const { return values_.at<unsigned char>(n * points_ + k); }

  static double middle_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  }

  // Where a reflection or a shadow lies over the edge, the contrast changes along it, and the place of the step too.
  [[nodiscard]] std::vector<Crossing> even_ones() const {
    std::vector<Crossing> all;
    std::vector<double> contrasts;
    for (int n = 0; n < lines_; ++n)
      if (const auto c = crossing(n)) {
        all.push_back(*c);
        contrasts.push_back(c->contrast);
      }
    if (all.empty()) return all;
    const double usual = middle_of(contrasts);
    std::erase_if(all, [usual](const Crossing& c) { return std::abs(c.contrast - usual) > kUneven * usual; });
    return all;
  }

  // The step between the ends' levels that has the same area as the profile.
  [[nodiscard]] std::optional<Crossing> crossing(int n) const {
    const double dark = 0.5 * (at(n, 0) + at(n, 1));
    const double light = 0.5 * (at(n, points_ - 1) + at(n, points_ - 2));
    if (light - dark < kLeastContrast) return std::nullopt;
    double area = 0;
    for (int k = 0; k < points_; ++k) area += (at(n, k) - dark) / (light - dark);
    const double place = way(points_ - 1) + 0.5 * kStep - area * kStep;
    if (std::abs(place) > reach_) return std::nullopt;
    return Crossing{foot(n) + place * out_, light - dark};
  }

  static Line through(const std::vector<Crossing>& crossings) {
    Vector2 mean = Vector2::Zero();
    for (const Crossing& c : crossings) mean += c.p / static_cast<double>(crossings.size());
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    for (const Crossing& c : crossings) scatter += (c.p - mean) * (c.p - mean).transpose();
    const double angle = 0.5 * std::atan2(2 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
    const Vector2 n(-std::sin(angle), std::cos(angle));
    return {n, n.dot(mean), 0, 0};
  }

  Vector2 from_;
  Vector2 along_;
  Vector2 out_;
  double reach_{};
  int points_{};
  int lines_{};
  cv::Mat values_;
};

// Not finite when they are parallel.
Vector2 meeting(const Line& a, const Line& b) {
  const double det = a.n.x() * b.n.y() - a.n.y() * b.n.x();
  return {(a.d * b.n.y() - b.d * a.n.y()) / det, (b.d * a.n.x() - a.d * b.n.x()) / det};
}

// Locates the edges on lines across those of corners that are roughly known.
std::optional<Border> located_near(const cv::Mat& grey, const Corners& c, const Corners& rough) {
  Border border{c, 0, 0};
  const Vector2 middle = 0.25 * (c[0] + c[1] + c[2] + c[3]);
  std::array<Line, 4> lines;
  for (std::size_t k = 0; k < 4; ++k) {
    if ((c[(k + 1) % 4] - c[k]).norm() < 12) return std::nullopt;
    const Edge edge(grey, c[k], c[(k + 1) % 4], middle);
    const auto line = edge.line();
    if (!line) return std::nullopt;
    lines[k] = *line;
    border.sigma = std::max(border.sigma, line->sigma);
    border.blur = std::max(border.blur, edge.blur());
  }
  const auto [faint, strong] = std::ranges::minmax(lines, {}, &Line::contrast);
  if (faint.contrast < kAlike * strong.contrast) return std::nullopt;
  for (std::size_t k = 0; k < 4; ++k) {
    border.corners[k] = meeting(lines[(k + 3) % 4], lines[k]);
    if (!((border.corners[k] - rough[k]).norm() <= 4)) return std::nullopt;
  }
  return border;
}

}  // namespace

std::optional<Border> locate_border(const cv::Mat& grey, const Corners& rough) {
  const auto first = located_near(grey, rough, rough);
  return first ? located_near(grey, first->corners, rough) : std::nullopt;
}

}  // namespace mrroc::vsp
