// The border of a tag against its formulas: squares of any size, turn, sharpness and light, with dirt on their edges.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "vsp/apriltag/border.hpp"

namespace mrroc::vsp {
namespace {

constexpr int kSize = 110;

struct Place {
  Vector2 p;
  double contrast{};
};
struct StraightLine {
  Vector2 normal{0, 0};
  double distance{}, sigma{}, contrast{}, blur{};
};

double middle_of(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// One edge and the lines across it: up to 3 pixels or 0.075 of the edge to either side, every half pixel.
class Across {
 public:
  Across(const cv::Mat& grey, const Vector2& from, const Vector2& to, const Vector2& middle)
      : from_(from), along_(to - from) {
    const double edge = along_.norm();
    out_ = Vector2(-along_.y(), along_.x()) / edge;
    if (out_.dot(middle - from) > 0) out_ = -out_;
    reach_ = std::min(3.0, 0.075 * edge);
    half_ = static_cast<int>(2 * reach_);
    count_ = std::clamp(static_cast<int>(0.76 * edge), 8, 150);
    for (int n = 0; n < count_; ++n) {
      cv::Mat places(1, 2 * half_ + 1, CV_32FC2);
      for (int k = -half_; k <= half_; ++k) {
        const Vector2 p = foot(n) + 0.5 * k * out_;
        places.at<cv::Point2f>(0, k + half_) = {static_cast<float>(p.x()), static_cast<float>(p.y())};
      }
      cv::Mat values;
      cv::remap(grey, values, places, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
      profiles_.emplace_back(values.begin<unsigned char>(), values.end<unsigned char>());
    }
  }
  [[nodiscard]] int count() const { return count_; }

  /// @return where the edge is, on the lines across whose contrast is the usual one
  [[nodiscard]] std::vector<Place> places() const {
    std::vector<Place> all;
    std::vector<double> contrasts;
    for (int n = 0; n < count_; ++n) {
      const std::vector<double>& p = profiles_[static_cast<std::size_t>(n)];
      const double dark = (p[0] + p[1]) / 2, light = (p.end()[-1] + p.end()[-2]) / 2;
      if (light < dark + 12) continue;
      double lit = 0;
      for (const double x : p) lit += 0.5 * (x - dark) / (light - dark);
      const double at = 0.5 * half_ + 0.25 - lit;
      if (std::abs(at) > reach_) continue;
      all.push_back({foot(n) + at * out_, light - dark});
      contrasts.push_back(light - dark);
    }
    if (all.empty()) return all;
    const double usual = middle_of(contrasts);
    std::erase_if(all,
                  [=](const Place& c) { return c.contrast > 1.35 * usual || c.contrast < 0.65 * usual; });
    return all;
  }

  /// @return standard deviation of a blur whose steepest place is that of the mean profile
  [[nodiscard]] double blur() const {
    std::vector<double> mean(profiles_.front().size(), 0);
    for (const auto& p : profiles_)
      for (std::size_t k = 0; k < p.size(); ++k) mean[k] += p[k] / count_;
    double steepest = 0;
    for (std::size_t k = 2; k < mean.size(); ++k) steepest = std::max(steepest, mean[k] - mean[k - 2]);
    return (mean.back() - mean.front()) / steepest / std::sqrt(2 * std::numbers::pi);
  }

 private:
  [[nodiscard]] Vector2 foot(int n) const { return from_ + (0.12 + 0.76 * (n + 0.5) / count_) * along_; }

  Vector2 from_, along_, out_;
  double reach_{};
  int half_{}, count_{};
  std::vector<std::vector<double>> profiles_;
};

/// @return the line in the middle of the places, in three rounds without those that are four medians off
std::optional<StraightLine> through(const Across& edge) {
  std::vector<Place> places = edge.places();
  for (int round = 1;; ++round) {
    const auto n = static_cast<double>(places.size());
    if (n < 0.7 * edge.count()) return std::nullopt;
    Vector2 mean = Vector2::Zero();
    for (const Place& c : places) mean += c.p / n;
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    for (const Place& c : places) scatter += (c.p - mean) * (c.p - mean).transpose();
    StraightLine line{.normal =
                          Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(scatter).eigenvectors().col(0)};
    line.distance = line.normal.dot(mean);
    const auto off = [&line](const Place& c) { return std::abs(line.normal.dot(c.p) - line.distance); };
    std::vector<double> all_off;
    for (const Place& c : places) all_off.push_back(off(c));
    const double limit = std::max(0.05, 4 * middle_of(all_off));
    std::vector<Place> near;
    std::ranges::copy_if(places, std::back_inserter(near), [&](const Place& c) { return off(c) < limit; });
    if (near.size() == places.size() || round == 3) {
      double squares = 0;
      for (const Place& c : near) squares += off(c) * off(c);
      for (const Place& c : near) line.contrast += c.contrast / static_cast<double>(near.size());
      line.sigma = 2 * std::sqrt(squares) / static_cast<double>(near.size());
      line.blur = edge.blur();
      return line;
    }
    places = near;
  }
}

/// @return what border.hpp says: twice the edges, the second time from where they were found
std::optional<Border> expected(const cv::Mat& grey, const Corners& rough) {
  Corners c = rough;
  std::array<StraightLine, 4> lines;
  for (int round = 0; round < 2; ++round) {
    for (std::size_t k = 0; k < 4; ++k) {
      if ((c[(k + 1) % 4] - c[k]).norm() < 12) return std::nullopt;
      const auto line = through(Across(grey, c[k], c[(k + 1) % 4], (c[0] + c[1] + c[2] + c[3]) / 4));
      if (!line) return std::nullopt;
      lines[k] = *line;
    }
    const auto [faint, strong] = std::ranges::minmax(lines, {}, &StraightLine::contrast);
    if (faint.contrast < 0.6 * strong.contrast) return std::nullopt;
    for (std::size_t k = 0; k < 4; ++k) {
      Eigen::Matrix2d A;
      A << lines[(k + 3) % 4].normal.transpose(), lines[k].normal.transpose();
      c[k] = A.inverse() * Vector2(lines[(k + 3) % 4].distance, lines[k].distance);
      if ((c[k] - rough[k]).norm() > 4) return std::nullopt;
    }
  }
  Border border{c, 0, 0};
  for (const StraightLine& line : lines) {
    border.sigma = std::max(border.sigma, line.sigma);
    border.blur = std::max(border.blur, line.blur);
  }
  return border;
}

class AnyBorder : public testing::Test {
 protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }

  /// A square, no longer quite one, in any light, and now and then with a spot on it.
  cv::Mat picture(const Corners& c, double dark, double light) {
    const Vector2 shade(uniform(-0.4, 0.4), uniform(-0.4, 0.4)), side(uniform(-1, 1), uniform(-1, 1));
    const double shadow = uniform(0.4, 1);
    cv::Mat grey(kSize, kSize, CV_32F);
    for (int v = 0; v < kSize; ++v)
      for (int u = 0; u < kSize; ++u) {
        double sum = 0;
        for (int n = 0; n < 4; ++n) {
          const int across = n % 2, down = n / 2;
          const Vector2 p(u + across / 2.0 - 0.25, v + down / 2.0 - 0.25);
          const double lit = light + 100 * shade.dot(p / kSize - Vector2(0.5, 0.5));
          const bool shaded = side.dot(p - Vector2(55, 55)) > 25;
          sum += is_inside(c, p) ? dark : (shaded ? shadow * lit : lit);
        }
        grey.at<float>(v, u) = static_cast<float>(sum / 4);
      }
    if (uniform(0, 1) < 0.5)
      cv::circle(grey, {static_cast<int>(c[0].x() + 0.4 * (c[1] - c[0]).x()), static_cast<int>(c[0].y())},
                 1 + static_cast<int>(uniform(0, 5)), cv::Scalar(uniform(0, 255)), cv::FILLED);
    cv::GaussianBlur(grey, grey, {}, uniform(0.4, 1.3));
    cv::Mat noise(grey.size(), CV_32F), bytes;
    cv::RNG(random_()).fill(noise, cv::RNG::NORMAL, 0, uniform(0, 9));
    cv::Mat(grey + noise).convertTo(bytes, CV_8U);
    return bytes;
  }
  static bool is_inside(const Corners& c, const Vector2& p) {
    int left = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector2 along = c[(k + 1) % 4] - c[k], to = p - c[k];
      left += along.x() * to.y() > along.y() * to.x() ? 1 : 0;
    }
    return left % 4 == 0;
  }
  std::mt19937 random_{11};
};

TEST_F(AnyBorder, HasTheCornersTheirErrorAndTheBlurOfTheFormulas) {
  int found = 0, refused = 0;
  for (int run = 0; run < 400; ++run) {
    const double edge = run % 3 == 0 ? uniform(11, 20) : uniform(16, 70), turn = uniform(0, 6.3);
    Corners truth;
    for (std::size_t k = 0; k < 4; ++k) {
      const double angle = turn + (run % 2 == 0 ? 1 : -1) * static_cast<double>(k) * std::numbers::pi / 2;
      truth[k] = Vector2(uniform(-3, 3) + 55, uniform(-3, 3) + 55) +
                 edge / std::numbers::sqrt2 * Vector2(std::cos(angle), std::sin(angle));
    }
    const double dark = uniform(10, 80);
    const cv::Mat grey = picture(truth, dark, dark + uniform(10, 160));
    Corners rough = truth;
    const double off = uniform(0, 2.5);
    for (Vector2& c : rough) c += off * Vector2(uniform(-1, 1), uniform(-1, 1));
    const auto is = locate_border(grey, rough), would = expected(grey, rough);
    ASSERT_EQ(is.has_value(), would.has_value()) << run;
    ++(is ? found : refused);
    if (!is || !would) continue;
    for (std::size_t k = 0; k < 4; ++k) ASSERT_LT((is->corners[k] - would->corners[k]).norm(), 1e-7) << run;
    ASSERT_NEAR(is->sigma, would->sigma, 1e-8) << run;
    ASSERT_NEAR(is->blur, would->blur, 1e-8) << run;
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace mrroc::vsp
