// Random poses for the generators' tests.
#pragma once
#include <random>

#include "ecp/generators/space.hpp"

namespace mrroc::ecp {

/// Seeded random coordinates within +-range.
class RandomList {
 public:
  explicit RandomList(unsigned seed) : random_(seed) {}

  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<>(low, high)(random_); }
  Coordinates pose(int size, double range) {
    Coordinates q(size);
    for (double& x : q) x = between(-range, range);
    return q;
  }

 private:
  std::mt19937 random_;
};

/// Largest of |q| / limit over the coordinates.
inline double share_of(const Coordinates& q, const Coordinates& limit) {
  return q.cwiseAbs().cwiseQuotient(limit).maxCoeff();
}

}  // namespace mrroc::ecp
