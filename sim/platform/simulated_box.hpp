// One box of the simulation: its base slides on the ground, platforms push its sides.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/platform_transmission.hpp"
#include "sim/platform/motion_capture.hpp"
#include "sim/platform/planar_bodies.hpp"

namespace mrroc::sim {

/// Dry friction below a rectangular base on which a weight lies evenly: so many cells along each side share it, and the friction of
/// each is against its motion.
class SlidingBase {
 public:
  static constexpr std::size_t kCells = 8;  ///< along each side

  explicit SlidingBase(const BoxParameters& box) : k_(box) {}

  /// @param state   of the box, with the speeds that it would have after h without friction
  /// @param ground  its patches scale the friction @param time  simulated [s]
  /// @return friction during h: what brings the box to rest, or that of a base that slips
  [[nodiscard]] PlanarForce friction(const PlanarState& state, const GroundParameters& ground, double time,
                                     double h) const;
  /// @return about the vertical axis through the middle [kg m^2]
  [[nodiscard]] double inertia() const;

 private:
  [[nodiscard]] static bool holds(const PlanarForce& f, double most_force, double most_moment);
  [[nodiscard]] PlanarForce at_most(const PlanarForce& f, const PlanarState& state, double h) const;

  BoxParameters k_;
};

/// Used by PlatformWorld, which integrates the bodies between push() and follow().
class SimulatedBox {
 public:
  /// @param world   lives on; its ground and motion capture count here
  /// @param bodies  get the box; outlive it
  SimulatedBox(const BoxParameters& box, const PlatformWorldParameters& world, PlanarBodies& bodies,
               std::uint64_t seed);

  /// Friction on the ground, for the next integration. @param time  simulated [s] @param h  duration [s]
  void push(double time, double h);
  /// After the integration. @param h  its duration [s]
  void follow(double h);
  /// @param step  that ends, 1, 2, ... @param integrations  since the last one
  void end_step(std::int64_t step, int integrations);

  /// As PlatformWorld has them.
  [[nodiscard]] const std::optional<CapturedPose>& motion_capture() const { return captured_; }
  [[nodiscard]] const BoxTruth& truth() const { return truth_; }

  /// Calls visit(double) for every number of the state.
  template <class Visit>
  void visit_state(Visit visit) const {
    for (const double each : {state_.x, state_.y, state_.phi, state_.vx, state_.vy, state_.w, contact_.x,
                              contact_.y, contact_.moment})
      visit(each);
  }

 private:
  void observe(std::int64_t step, const PlanarForce& push);

  SlidingBase base_;
  double mass_;
  const PlatformWorldParameters& world_;
  PlanarBodies& bodies_;
  int body_;
  MotionCaptureSystem capture_;
  PlanarState state_;
  PlanarForce friction_;  // of the integration under way
  PlanarForce contact_;   // of all that touched it in the last one
  PlanarForce sum_;       // of the contacts' forces since the step began
  std::optional<CapturedPose> captured_;
  BoxTruth truth_;
};

}  // namespace mrroc::sim
