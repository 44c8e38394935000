#include "sim/bullet/round_prism.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc::sim {
namespace {

/// Sides of a direction's own corner whose corners are looked at: rounding moves it by less.
constexpr int kAround = 2;
/// Share of a direction below which corners are told apart by rounding alone; then all are looked at.
constexpr double kUpright = 1e-9;

}  // namespace

RoundPrism::RoundPrism(double length, double width, double thickness, int corners)
    : n_(corners), half_(length / 2, width / 2, thickness / 2) {
  m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
  m_collisionMargin = 0;  // it would stand out
  for (int k = 0; k < n_; ++k) {
    const double angle = 2 * std::numbers::pi * k / n_;
    for (const double z : {-thickness / 2, thickness / 2})
      all_.emplace_back(length / 2 * std::cos(angle), width / 2 * std::sin(angle), z);
  }
}

btVector3 RoundPrism::localGetSupportingVertexWithoutMargin(const btVector3& direction) const {
  std::size_t best = 0;
  double most = -SIMD_INFINITY;
  const auto look = [&](std::size_t corner) {
    const double reach = all_[corner].dot(direction);
    // Of equal ones the first, as in Bullet's hull.
    if (reach > most || (reach == most && corner < best)) {
      most = reach;
      best = corner;
    }
  };
  const double x = half_.x() * direction.x(), y = half_.y() * direction.y();
  // Of what is no number, too.
  if (!(std::abs(x) + std::abs(y) > kUpright * std::abs(half_.z() * direction.z()))) {
    for (std::size_t corner = 0; corner < all_.size(); ++corner) look(corner);
    return all_[best];
  }
  const int nearest = static_cast<int>(std::lround(std::atan2(y, x) / (2 * std::numbers::pi) * n_));
  for (int k = nearest - kAround; k <= nearest + kAround; ++k) {
    const auto side = static_cast<std::size_t>((k + 2 * n_) % n_);
    look(2 * side);
    look(2 * side + 1);
  }
  return all_[best];
}

void RoundPrism::batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions,
                                                                   btVector3* farthest, int count) const {
  std::transform(directions, directions + count, farthest,
                 [this](const btVector3& d) { return localGetSupportingVertexWithoutMargin(d); });
}

void RoundPrism::getAabb(const btTransform& T, btVector3& low, btVector3& high) const {
  btTransformAabb(half_, getMargin(), T, low, high);
}

void RoundPrism::calculateLocalInertia(btScalar mass, btVector3& inertia) const {
  const btVector3 square = half_ * half_;
  inertia = mass * btVector3(square.y() / 4 + square.z() / 3, square.x() / 4 + square.z() / 3,
                             (square.x() + square.y()) / 4);
}

}  // namespace mrroc::sim
