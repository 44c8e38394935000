#include "vsp/cube_face/face_search.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mrroc::vsp {
namespace {

using Row6 = Eigen::Matrix<double, 1, 6>;

constexpr int kSides = 4;
constexpr int kPoints = 9;          // along a side
constexpr double kMiddle = 0.8;     // share of a side on which they lie: corners are round
constexpr double kStep = 0.5;       // along a normal [pixel]
constexpr int kHalfWidth = 2;       // of the difference that finds edges, in such steps
constexpr double kRelative = 0.3;   // least change at an edge, as a share of the sticker's brightness
constexpr double kEdgeNoise = 0.4;  // standard deviation of an edge's place [pixel]
constexpr double kLastReach = 3;    // [pixel]
constexpr double kSupport = 1.3;    // an edge that far from where it must be supports nothing [pixel]
constexpr int kIterations = 8;
constexpr int kLeastWhole = 5;

/// A point of an edge, and what the picture says of it.
struct EdgePoint {
  Vector3 place;  // in G [m]
  Vector3 out;    // of the sticker, in G
  bool found{};
  double off{};          // of the edge from its place, outwards [pixel]
  Vector2 normal{0, 0};  // outwards, in the picture
};

std::vector<EdgePoint> edge_points(const CubeFaceShape& shape) {
  std::vector<EdgePoint> points;
  const double half = shape.sticker / 2;
  for (int sticker = 0; sticker < kStickers; ++sticker)
    for (int side = 0; side < kSides; ++side) {
      const Vector3 out = (side % 2 == 0 ? 1 : -1) * Vector3::Unit(side / 2);
      const Vector3 along = Vector3::Unit(1 - side / 2);
      for (int k = 0; k < kPoints; ++k) {
        const double at = kMiddle * half * (2.0 * k / (kPoints - 1) - 1);
        points.push_back({shape.middle(sticker) + half * out + at * along, out});
      }
    }
  return points;
}

/// @return brightness between pixels; the border's beyond it
double brightness(const cv::Mat& bright, const Vector2& p) {
  const double u = std::clamp(p.x(), 0.0, bright.cols - 1.001);
  const double v = std::clamp(p.y(), 0.0, bright.rows - 1.001);
  const int x = static_cast<int>(u);
  const int y = static_cast<int>(v);
  const double a = u - x;
  const double b = v - y;
  const auto* const upper = bright.ptr<std::uint8_t>(y) + x;
  const auto* const lower = bright.ptr<std::uint8_t>(y + 1) + x;
  return (1 - b) * ((1 - a) * upper[0] + a * upper[1]) + b * ((1 - a) * lower[0] + a * lower[1]);
}

/// Finds the strongest change from light to dark along the normal.
void look_along(const cv::Mat& bright, const CameraModel& camera, const Pose& T, double reach, double least,
                EdgePoint& e) {
  constexpr double kShort = 1e-4;  // [m]
  const Vector2 p = project(camera, T * e.place);
  e.normal = (project(camera, T * Vector3(e.place + kShort * e.out)) - p).normalized();
  const int steps = static_cast<int>(std::ceil(reach / kStep));
  const auto change = [&](int k) {
    return brightness(bright, p + kStep * (k - kHalfWidth) * e.normal) -
           brightness(bright, p + kStep * (k + kHalfWidth) * e.normal);
  };
  int at = 0;
  double most = 0;
  for (int k = -steps; k <= steps; ++k)
    if (const double c = change(k); c > most) most = c, at = k;
  const double inside = brightness(bright, p + kStep * (at - 2 * kHalfWidth) * e.normal);
  e.found = most > std::max(least, kRelative * inside);
  if (!e.found) return;
  const double before = change(at - 1);
  const double after = change(at + 1);
  const double bend = before - 2 * most + after;
  e.off = kStep * (at + (bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0));
}

Pose moved(const Pose& T, const Vector6& by) {
  return {rotation_from_angle_axis(by.tail<3>()) * T.R, T.p + by.head<3>()};
}

/// @return how the place of an edge in the picture changes along its normal
Row6 jacobian(const CameraModel& camera, const Pose& T, const EdgePoint& e) {
  constexpr double kShort = 1e-5;  // [m], [rad]
  Row6 J;
  for (int k = 0; k < 6; ++k) {
    const Vector6 by = kShort * Vector6::Unit(k);
    J[k] = e.normal.dot(project(camera, moved(T, by) * e.place) - project(camera, moved(T, -by) * e.place)) /
           (2 * kShort);
  }
  return J;
}

/// @return robust standard deviation of what was found
double spread(const std::vector<EdgePoint>& points) {
  std::vector<double> off;
  for (const EdgePoint& e : points)
    if (e.found) off.push_back(std::abs(e.off));
  if (off.empty()) return 0;
  const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
  std::ranges::nth_element(off, middle);
  return 1.4826 * *middle;
}

/// The pose that is likeliest given the edges and the place.
class Fit {
 public:
  Fit(const CameraModel& camera, const Pose& place, const CubeFaceParameters& k)
      : camera_(camera), place_(place), T_(place) {
    weight_.head<3>().setConstant(1 / (k.place_error * k.place_error));
    weight_.tail<3>().setConstant(1 / (k.angle_error * k.angle_error));
  }

  void improve(const std::vector<EdgePoint>& points) {
    Vector6 from_place;
    from_place << T_.p - place_.p, angle_axis_from_rotation(T_.R * place_.R.transpose());
    information_ = weight_.asDiagonal();
    Vector6 gradient = weight_.cwiseProduct(-from_place);
    const double cut = 4.7 * std::max(kEdgeNoise, spread(points));  // Tukey's
    for (const EdgePoint& e : points) {
      if (!e.found || std::abs(e.off) >= cut) continue;
      const double u = e.off / cut;
      const double w = (1 - u * u) * (1 - u * u) / (kEdgeNoise * kEdgeNoise);
      const Row6 J = jacobian(camera_, T_, e);
      information_ += w * J.transpose() * J;
      gradient += w * e.off * J.transpose();
    }
    T_ = moved(T_, information_.ldlt().solve(gradient));
  }

  [[nodiscard]] const Pose& pose() const { return T_; }
  [[nodiscard]] Matrix6 covariance() const { return information_.inverse(); }
  /// @return largest departure from the place, in its standard deviations
  [[nodiscard]] double departure() const {
    Vector6 d;
    d << T_.p - place_.p, angle_axis_from_rotation(T_.R * place_.R.transpose());
    return d.cwiseAbs2().cwiseProduct(weight_).maxCoeff();
  }

 private:
  const CameraModel& camera_;
  Pose place_, T_;
  Vector6 weight_;
  Matrix6 information_ = Matrix6::Zero();
};

}  // namespace

std::optional<FoundFace> find_face(const cv::Mat& bright, const CameraModel& camera, const Pose& place,
                                   const CubeFaceShape& shape, const CubeFaceParameters& k) {
  constexpr double kTurnShare = 0.5;  // of the angle's error at the face's corners, in the picture
  std::vector<EdgePoint> points = edge_points(shape);
  Fit fit(camera, place, k);
  const double scale = std::max(camera.fx, camera.fy) / place.p.z();  // [pixel/m]
  double reach =
      std::min(k.place_error + kTurnShare * k.angle_error * shape.edge, 0.45 * shape.edge / 3) * scale;
  for (int i = 0; i < kIterations; ++i) {
    for (EdgePoint& e : points) look_along(bright, camera, fit.pose(), reach, k.contrast, e);
    fit.improve(points);
    if (!is_proper(fit.pose()) || fit.pose().p.z() < 0.5 * place.p.z()) return {};
    reach = std::max(kLastReach, 0.6 * reach);
  }
  FoundFace face;
  face.T_CG = {orthonormal(fit.pose().R), fit.pose().p};
  face.covariance = fit.covariance();
  double sum = 0;
  int supporting = 0;
  face.whole.fill(true);
  for (std::size_t side = 0; side < kStickers * kSides; ++side) {
    int here = 0;
    for (std::size_t n = 0; n < kPoints; ++n) {
      EdgePoint& e = points[side * kPoints + n];
      look_along(bright, camera, fit.pose(), kLastReach, k.contrast, e);
      if (!e.found || std::abs(e.off) > kSupport) continue;
      ++here;
      sum += e.off * e.off;
    }
    supporting += here;
    if (here < k.edge_share * kPoints) face.whole[side / kSides] = false;
  }
  constexpr double kMostDepartures = 4;  // squared standard deviations
  face.rms_px = std::sqrt(sum / std::max(1, supporting));
  if (std::ranges::count(face.whole, true) < kLeastWhole || face.rms_px > k.rms_px ||
      fit.departure() > kMostDepartures)
    return {};
  return face;
}

}  // namespace mrroc::vsp
