// The pose of a face against its formulas: any face near its place, with noise and dirt on its stickers.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>
#include <vector>

#include "vsp/cube_face/face_search.hpp"

namespace mrroc::vsp {
namespace {

constexpr int kWidth = 190, kHeight = 170;

CameraModel camera(double zoom = 1) {
  CameraModel c;
  c.width = kWidth;
  c.height = kHeight;
  c.fx = 1000 * zoom;
  c.fy = 1030 * zoom;
  c.cx = 96;
  c.cy = 83;
  c.distortion = {-0.1, 0.02, 0.001, -0.0005, 0};
  return c;
}

/// @return brightness between the pixels of the picture, beyond it that of its border
double light(const cv::Mat& picture, const Vector2& p) {
  const double u = std::min(std::max(p.x(), 0.0), kWidth - 1.001),
               v = std::min(std::max(p.y(), 0.0), kHeight - 1.001);
  const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
  double sum = 0;
  for (const int i : {0, 1})
    for (const int j : {0, 1})
      sum += (1 - std::abs(u - x - i)) * (1 - std::abs(v - y - j)) * picture.at<unsigned char>(y + j, x + i);
  return sum;
}

/// A place on an edge of a sticker, and how far outside of it the edge is seen.
struct Edge {
  Vector3 p, out;
  Vector2 normal{0, 0};
  std::optional<double> off{};
};

class Reference {
 public:
  Reference(const cv::Mat& picture, const CameraModel& c, const Pose& place, const CubeFaceParameters& k)
      : picture_(picture), c_(c), k_(k), place_(place), T_(place) {
    const double half = kCubeFace.sticker / 2;
    for (int s = 0; s < kStickers; ++s)
      for (const Vector3& out : {Vector3(1, 0, 0), Vector3(-1, 0, 0), Vector3(0, 1, 0), Vector3(0, -1, 0)})
        for (int n = -4; n <= 4; ++n)
          edges_.push_back(
              {kCubeFace.middle(s) + half * out + 0.2 * n * half * Vector3(out.y(), out.x(), 0).cwiseAbs(),
               out});
  }

  std::optional<FoundFace> found() {
    double reach = std::min(k_.place_error + 0.5 * k_.angle_error * kCubeFace.edge, 0.15 * kCubeFace.edge) *
                   std::max(c_.fx, c_.fy) / place_.p.z();
    for (int round = 0; round < 8; ++round) {
      for (Edge& e : edges_) look(e, reach);
      improve();
      if (!is_proper(T_) || T_.p.z() < 0.5 * place_.p.z()) return std::nullopt;
      reach = std::max(3.0, 0.6 * reach);
    }
    FoundFace face;
    face.T_CG = {orthonormal(T_.R), T_.p};
    face.covariance = information_.inverse();
    face.whole.fill(true);
    double squares = 0, supporting = 0;
    for (std::size_t side = 0; side < edges_.size() / 9; ++side) {
      int here = 0;
      for (std::size_t n = 9 * side; n < 9 * side + 9; ++n) {
        look(edges_[n], 3);
        const double off = edges_[n].off.value_or(9);
        if (std::abs(off) > 1.3) continue;
        ++here;
        squares += off * off;
      }
      supporting += here;
      if (here < 9 * k_.edge_share) face.whole[side / 4] = false;
    }
    face.rms_px = std::sqrt(squares / std::max(1.0, supporting));
    const Vector6 most = departure().cwiseAbs();
    const bool far =
        most.head<3>().maxCoeff() > 2 * k_.place_error || most.tail<3>().maxCoeff() > 2 * k_.angle_error;
    if (std::ranges::count(face.whole, true) < 5 || face.rms_px > k_.rms_px || far) return std::nullopt;
    return face;
  }

 private:
  [[nodiscard]] Vector2 seen(const Pose& T, const Vector3& p) const { return project(c_, T * p); }

  void look(Edge& e, double reach) const {
    const Vector2 p = seen(T_, e.p);
    e.normal = (seen(T_, e.p + 1e-4 * e.out) - p).normalized();
    const auto at = [&](int k) { return light(picture_, p + 0.5 * k * e.normal); };
    const auto step = [&](int k) { return at(k - 2) - at(k + 2); };
    const int most = static_cast<int>(std::ceil(2 * reach));
    int best = 0;
    double strongest = 0;
    for (int k = -most; k <= most; ++k)
      if (step(k) > strongest) {
        best = k;
        strongest = step(k);
      }
    e.off.reset();
    if (strongest <= std::max(k_.contrast, 0.3 * at(best - 4))) return;
    // The vertex of the parabola through three steps.
    const double a = step(best - 1), b = step(best + 1), bend = 2 * strongest - a - b;
    const double vertex = bend > 0 ? std::min(0.5, std::max(-0.5, 0.5 * (b - a) / bend)) : 0;
    e.off = 0.5 * (best + vertex);
  }

  [[nodiscard]] Vector6 departure() const {
    Vector6 d;
    d << T_.p - place_.p, angle_axis_from_rotation(T_.R * place_.R.transpose());
    return d;
  }
  [[nodiscard]] Pose moved(const Vector6& by) const {
    return {rotation_from_angle_axis(by.tail<3>()) * T_.R, T_.p + by.head<3>()};
  }

  /// A step of Gauss and Newton, with Tukey's weights and what is known of the place.
  void improve() {
    std::vector<double> all;
    for (const Edge& e : edges_)
      if (e.off) all.push_back(std::abs(*e.off));
    std::ranges::sort(all);
    const double cut = 4.7 * std::max(0.4, all.empty() ? 0 : 1.4826 * all[all.size() / 2]);
    Vector6 known;
    known << Vector3::Constant(1 / std::pow(k_.place_error, 2)),
        Vector3::Constant(1 / std::pow(k_.angle_error, 2));
    information_ = known.asDiagonal();
    Vector6 pull = -known.cwiseProduct(departure());
    for (const Edge& e : edges_) {
      if (!e.off || std::abs(*e.off) >= cut) continue;
      const double weight = std::pow((1 - std::pow(*e.off / cut, 2)) / 0.4, 2);
      Vector6 J;
      for (int n = 0; n < 6; ++n) {
        const Vector6 by = 1e-5 * Vector6::Unit(n);
        J[n] = e.normal.dot(seen(moved(by), e.p) - seen(moved(-by), e.p)) / 2e-5;
      }
      information_ += weight * J * J.transpose();
      pull += weight * *e.off * J;
    }
    T_ = moved(information_.ldlt().solve(pull));
  }

  const cv::Mat& picture_;
  CameraModel c_;
  CubeFaceParameters k_;
  Pose place_, T_;
  Matrix6 information_ = Matrix6::Zero();
  std::vector<Edge> edges_;
};

class AnyFace : public testing::Test {
 protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }

  cv::Mat picture(const CameraModel& c, const Pose& T_CG) {
    std::array<double, kStickers> grey{};
    for (double& g : grey) g = uniform(0, 1) < 0.15 ? 20 : uniform(60, 240);
    cv::Mat result(kHeight, kWidth, CV_8U, cv::Scalar(15));
    for (int s = 0; s < kStickers; ++s) {
      std::vector<cv::Point> outline;
      for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        const Vector2 p =
            project(c, T_CG * Vector3(kCubeFace.middle(s) + 0.5 * kCubeFace.sticker * Vector3(x, y, 0)));
        outline.emplace_back(static_cast<int>(std::lround(16 * p.x())),
                             static_cast<int>(std::lround(16 * p.y())));
      }
      cv::fillConvexPoly(result, outline, cv::Scalar(grey[static_cast<std::size_t>(s)]), cv::LINE_AA, 4);
    }
    const int spots = static_cast<int>(uniform(0, 4));
    for (int k = 0; k < spots; ++k)
      cv::circle(result, {static_cast<int>(uniform(20, 170)), static_cast<int>(uniform(20, 150))},
                 static_cast<int>(uniform(1, 7)), cv::Scalar(uniform(0, 255)), cv::FILLED);
    cv::GaussianBlur(result, result, {}, uniform(0.5, 1.2));
    cv::Mat noise(result.size(), CV_8U);
    cv::RNG(random_()).fill(noise, cv::RNG::UNIFORM, 0, uniform(1, 12));
    return result + noise;
  }
  std::mt19937 random_{12};
};

TEST_F(AnyFace, HasThePoseThatIsLikeliestForItsEdges) {
  int found = 0, refused = 0, same = 0;
  for (int run = 0; run < 120; ++run) {
    const CameraModel c = camera(run % 3 == 0 ? 1.25 : 1);
    const Pose place{rotation_from_angle_axis({0.3 * uniform(-1, 1), 0.3 * uniform(-1, 1), uniform(-1, 1)}) *
                         rotation_from_angle_axis({M_PI, 0, 0}),
                     {0.002 * uniform(-1, 1), 0.002 * uniform(-1, 1), uniform(0.42, 0.5)}};
    CubeFaceParameters k;
    k.place_error = uniform(0.001, 0.008);
    k.angle_error = uniform(0.02, 0.08);
    k.contrast = uniform(4, 30);
    k.edge_share = uniform(0.3, 0.7);
    k.rms_px = uniform(0.35, 1);
    const auto off = [&](double by) { return Vector3(uniform(-by, by), uniform(-by, by), uniform(-by, by)); };
    const Pose T{rotation_from_angle_axis(off(0.7 * k.angle_error)) * place.R,
                 place.p + off(0.7 * k.place_error)};
    const cv::Mat bright = picture(c, T);
    const auto is = find_face(bright, c, place, kCubeFace, k), would = Reference(bright, c, place, k).found();
    ++(is ? found : refused);
    if (!is || !would) {
      same += !is && !would ? 1 : 0;
      continue;
    }
    const bool alike = is->whole == would->whole && (is->T_CG.p - would->T_CG.p).norm() < 1e-10 &&
                       (is->T_CG.R - would->T_CG.R).norm() < 1e-9 &&
                       (is->covariance - would->covariance).norm() < 1e-7 * is->covariance.norm() &&
                       std::abs(is->rms_px - would->rms_px) < 1e-8;
    same += alike ? 1 : 0;
  }
  EXPECT_GE(same, 116) << "where two changes are as strong, rounding says which is the edge";
  EXPECT_GT(found, 30);
  EXPECT_GT(refused, 30);
}

}  // namespace
}  // namespace mrroc::vsp
