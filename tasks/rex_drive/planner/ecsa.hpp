// Motion planning in the endogenous configuration space (REX 3.1, its refs. 11, 14): the space of the controls u(.) of
//     x' = v cos phi, y' = v sin phi, phi' = w     over a horizon T
// with the end-point map K(u(.)) = q(T). Newton's method with a weighted pseudo-inverse of the map's Jacobian finds
// controls that lead to a given end.
//
// u(.) is a combination of 1, sin(k pi t / T), cos(k pi t / T), k = 1..3, one per control. Half periods: whole ones would
// force u(0) = u(T), and no fragment could end at another speed than it began with.
#pragma once
#include <array>
#include <cstdint>

#include "base/platform_path.hpp"

namespace mrroc::rex_drive {

/// What controls are wanted for.
struct EndPointProblem {
  PathPoint from{};   ///< q(0), and u(0) = (v, w)
  PathPoint to{};     ///< q(T) with phi unwrapped, and u(T)
  double duration{};  ///< T [s], > 0
};

/// Settings of the search.
struct EcsaSettings {
  double tolerance{1e-4};  ///< on the norm of all errors together [m, rad, m/s, rad/s]
  int max_iterations{60};  ///< of Newton's method
  int max_halvings{8};     ///< of one step
  double damping{1e-6};    ///< of the pseudo-inverse, share of the mean diagonal
  double smoothness{0.3};  ///< weight of harmonic k is 1 + smoothness k^2
  double steadiness{
      20};  ///< weight of v to that of w [s^2/m^2]: the way is bent rather than driven back and forth
};

/// Controls that were found, as the points of the way.
struct EndPointSolution {
  bool converged{};           ///< the error is within the tolerance
  std::int32_t iterations{};  ///< that it took
  double error{};             ///< norm of the errors
  std::array<PathPoint, kFragmentKnots>
      knot{};        ///< evenly over the horizon; the ends are as in the problem when converged
  double length{};   ///< of the way [m]
  double least_v{};  ///< smallest v on the way [m/s]
  double most_v{};   ///< largest v [m/s]
  double most_w{};   ///< largest |w| [rad/s]
  double most_vw{};  ///< largest |v w| [m/s^2]
};

/// Solves it. The numbers of the problem must be finite. The same problem gives the same bits.
[[nodiscard]] EndPointSolution solve(const EndPointProblem& problem, const EcsaSettings& settings = {});

}  // namespace mrroc::rex_drive
