// Rigid bodies that move on the ground, and run into walls, obstacles and one another. The only code of platforms that
// knows Bullet is behind it.
#pragma once
#include <memory>
#include <optional>

#include "base/room_config.hpp"
#include "sim/platform/skid_steer.hpp"

namespace mrroc::sim {

/// Friction of a platform's outline against a wall or an obstacle; between two of them it is its square.
inline constexpr double kOutlineFriction = 0.4;

/// A body with a rectangular outline.
struct PlanarBody {
  double mass{};                   ///< [kg], > 0
  double inertia{};                ///< about the vertical axis through the centre of mass [kg m^2], > 0
  double length{}, width{};        ///< of the outline [m], > 0
  std::array<double, 2> middle{};  ///< of the outline, from the centre of mass, along the body [m]
  /// Coefficient of friction against whatever it touches, >= 0; of two that have one the smaller counts. Nothing: a platform,
  /// with kOutlineFriction.
  std::optional<double> grip{};
};

/// Bodies that move in x, y and about z only, in a room. Deterministic.
class PlanarBodies {
 public:
  explicit PlanarBodies(const Room& room);
  ~PlanarBodies();
  PlanarBodies(const PlanarBodies&) = delete;
  PlanarBodies& operator=(const PlanarBodies&) = delete;

  /// @param state  at the beginning @return number of the body: 0, 1, ...
  int add(const PlanarBody& body, const PlanarState& state);
  /// A force during the next integration, and no other.
  void push(int body, const PlanarForce& force);
  /// Moves all bodies on. @param h [s]
  void integrate(double h);
  /// @return present state; phi within (-pi, pi]
  [[nodiscard]] PlanarState state(int body) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrroc::sim
