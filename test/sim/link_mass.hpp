// Mass matrix of an arm's links, from its description alone: what a controller believes, and no engine computes.
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "sim/chain.hpp"

namespace mrroc::sim {

/// @param chain  without jaws, rotors as it has them @param joints  [rad], track [m]
/// @return [kg m^2], track [kg]
inline AxisMatrix link_mass(const Chain& chain, const AxisVector& joints) {
  const auto n = joints.size();
  AxisMatrix mass = AxisMatrix::Zero(n, n);
  Eigen::MatrixXd axes(3, n), places(3, n);
  Pose T;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    const ChainLink& link = chain.links[i];
    T = T * link.T_PL;
    const auto k = static_cast<Eigen::Index>(i);
    if (!link.fixed) {
      axes.col(k) = T.R * link.axis;
      places.col(k) = T.p;
      if (link.prismatic)
        T.p += joints[k] * axes.col(k);
      else
        T.R = T.R * Eigen::AngleAxisd(joints[k], link.axis).toRotationMatrix();
    }
    Eigen::MatrixXd way = Eigen::MatrixXd::Zero(3, n), turn = way;
    for (Eigen::Index j = 0; j < n && j <= k; ++j) {
      const bool slides = chain.links[static_cast<std::size_t>(j)].prismatic;
      const Vector3 axis = axes.col(j), arm = T * link.mass_centre - places.col(j);
      way.col(j) = slides ? axis : Vector3(axis.cross(arm));
      if (!slides) turn.col(j) = axis;
    }
    const Matrix3 inertia = T.R * link.inertia.asDiagonal() * T.R.transpose();
    mass += link.mass * way.transpose() * way + turn.transpose() * inertia * turn;
  }
  return mass;
}

}  // namespace mrroc::sim
