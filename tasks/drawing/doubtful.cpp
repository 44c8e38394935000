#include "tasks/drawing/doubtful.hpp"

#include <Eigen/LU>
#include <cmath>
#include <vector>

namespace mrroc::drawing {
namespace {

constexpr double kSlope = 0.05;      // of a sheet, standard deviation [rad]
constexpr double kRoughness = 1e-3;  // of a node on the paper from the plane [m]

// Places of the pen at the ends of the nodes, z into the paper [m].
std::vector<Vector3> path_of(const Recording& recording) {
  std::vector<Vector3> path;
  Vector3 p = Vector3::Zero();
  for (std::size_t n = 0; n < recording.size(); ++n) {
    p += recording.macrostep_s() * recording[n].velocity.linear();
    path.push_back(p);
  }
  return path;
}

bool on_paper(const Recording& recording, std::size_t n) {
  return recording[n].pen == PenState::paper_surface;
}

// Depth z = plane' (1, x, y) of the nodes on the paper.
Vector3 plane_of(const Recording& recording, const std::vector<Vector3>& path) {
  const double prior = kRoughness * kRoughness / (kSlope * kSlope);
  Matrix3 H = Vector3(0, prior, prior).asDiagonal().toDenseMatrix();
  Vector3 g = Vector3::Zero();
  for (std::size_t n = 0; n < path.size(); ++n) {
    if (!on_paper(recording, n)) continue;
    const Vector3 s(1, path[n].x(), path[n].y());
    H += s * s.transpose();
    g += path[n].z() * s;
  }
  return H.fullPivLu().solve(g);
}

}  // namespace

int doubtful_strokes(const Recording& recording) {
  const std::vector<Vector3> path = path_of(recording);
  const Vector3 plane = plane_of(recording, path);
  const auto height = [&](std::size_t n) {
    return plane.dot(Vector3(1, path[n].x(), path[n].y())) - path[n].z();
  };
  int doubtful = 0;
  for (std::size_t begin = 0; begin < path.size();) {
    std::size_t end = begin;
    double sum = 0;
    bool smears = false;
    std::size_t low = begin;  // since when the pen has been low
    for (; end < path.size() && on_paper(recording, end) == on_paper(recording, begin); ++end) {
      sum += height(end);
      if (height(end) > kLowTravel) low = end + 1;
      smears = smears || (low < end && (path[end] - path[low]).head<2>().norm() > kSmear);
    }
    const bool off = std::abs(sum / static_cast<double>(end - begin)) > kOffPaper;
    doubtful += on_paper(recording, begin) ? off : smears;
    begin = end;
  }
  return doubtful;
}

}  // namespace mrroc::drawing
