// Resistance of a cube's face to being turned: its seat, friction that depends on the angle, and a jam.
#pragma once
#include <array>
#include <cstdint>
#include <random>

namespace mrroc::sim {

/// Friction of one face about its axis, over the angle from its last seat. Figures of the order of MG fig. 17.
struct FaceFriction {
  double breakaway{3.2};  ///< that leads out of the seat [N m]
  double kinetic{1.9};    ///< on the way, in the mean [N m]
  double ripple{0.2};     ///< of kinetic, eight times a turn
  double ripple_phase{};  ///< [rad]
  double viscous{0.2};    ///< [N m s/rad]
  double jam{};           ///< besides in the middle of the place where the face jams; back it goes free [N m]
  double jam_angle{0.7};  ///< that place, within the quarter turn, the same in both directions [rad]
  int jam_direction{};    ///< 0: a jam resists in both directions; 1, -1: a positive, a negative turn alone
  double jam_loosening{};       ///< share that a jam loses each time the face leaves its place, 0..1
  double jam_width{0.06};       ///< half of its width [rad]
  double detent{1.5};           ///< largest torque that draws the face into a seat [N m]
  double detent_friction{0.4};  ///< instead of kinetic where a seat draws [N m]
};

/// Differences between faces.
struct FaceFrictionSpread {
  FaceFriction mean;      ///< of all faces
  double factor{0.1};     ///< relative standard deviation of breakaway and kinetic, at most twice that
  double jam{1.0};        ///< a face jams by up to that [N m]
  std::uint64_t seed{1};  ///< of the faces
};

/// @return six faces in the order U R F D L B
[[nodiscard]] std::array<FaceFriction, 6> face_frictions(const FaceFrictionSpread& spread);

/// Angles at which a seat draws a face, from its middle [rad]; and at which a face counts as seated.
inline constexpr double kDetent = 0.061;
inline constexpr double kSeat = 0.009;

/// The state of one face. Deterministic, no allocation.
class FaceDrive {
 public:
  /// Friction and torque about the axis of the face in the next integration.
  struct Action {
    double speed{};     ///< that friction tries to hold [rad/s]
    double positive{};  ///< friction at most, against a positive turn [N m]
    double negative{};  ///< the same against a negative one [N m]
    double torque{};    ///< of the seat that draws [N m]
  };

  /// Begins in a seat.
  explicit FaceDrive(const FaceFriction& friction) : f_(friction) {}

  /// @param angle  from the seat in which the face began [rad]  @param speed [rad/s]  @param h integration step [s]
  [[nodiscard]] Action step(double angle, double speed, double h);

  /// From now on the face has this friction.
  void set_friction(const FaceFriction& friction) { f_ = friction; }
  /// @return whether the seat holds it: it has not been turned by more than kSeat since
  [[nodiscard]] bool seated() const { return seated_; }

 private:
  FaceFriction f_;
  bool seated_{true};
  int came_{};           // direction in which it came to where it jams: 1, -1; 0: it is elsewhere
  double tightness_{1};  // what is left of the jam
};

}  // namespace mrroc::sim
