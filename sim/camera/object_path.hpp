// The object that the cameras look for: its kind, its pose at any time, and its visibility.
#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "base/pose.hpp"
#include "sim/camera/scene.hpp"
#include "sim/camera/textures.hpp"

namespace mrroc::sim {

/// Kind of the object.
enum class ObjectKind : std::uint8_t {
  none,
  chessboard,
  apriltag,
  wrong_board,  ///< a chessboard with other numbers of squares than the one that is looked for
};

/// Motion of the object.
enum class ObjectMotion : std::uint8_t {
  rest,
  line,    ///< speeds up, goes a length along a straight line, stops
  circle,  ///< the same around a centre, without an end
  hand,    ///< somebody moves it about, smoothly and never the same way twice
};

/// The object G and its motion, in the base 0 of an arm, or in its hand. Frame G as in sim/camera/textures.hpp.
struct ObjectParameters {
  ObjectKind kind{ObjectKind::none};        ///< what it is
  std::string arm;                          ///< key of the arm in whose base this is
  bool in_hand{};                           ///< it is fixed to that arm's hand, where it is at rest
  Pose T_0G;                                ///< at the beginning; E_G T of an object in the hand [m]
  camera::BoardSize board;                  ///< of a chessboard
  int tag{0};                               ///< number of an AprilTag
  double tag_edge{0.1};                     ///< of its black border [m]
  ObjectMotion motion{ObjectMotion::rest};  ///< how it moves
  double start{1};                          ///< when it begins to move [s]
  double heading{0};         ///< of its first motion, in the xy plane of the base, 0: along x [rad]
  double speed{0.1};         ///< [m/s]
  double acceleration{0.5};  ///< [m/s^2]
  double length{0.3};        ///< of the line [m]
  double radius{0.08};       ///< of the circle, which lies to the left of the heading [m]
  double reach{0.06};        ///< of the hand along each axis [m]; a third of it upwards
  double turn{0.3};          ///< of the hand about z [rad]
  double pace{0.25};         ///< of the hand: its main frequency [1/s]
  double absent_until{0};    ///< when it is put there [s]
  double hidden_from{0};     ///< when a plate is held over it [s]
  double hidden_for{0};      ///< how long [s]
  std::uint64_t seed{1};     ///< of the hand
};

/// The object at one instant.
struct ObjectState {
  Pose T_0G;       ///< in the base of its arm
  bool present{};  ///< it has been put there
  bool hidden{};   ///< the plate is held over it
};

/// Pose of the object, a function of time alone.
class ObjectPath {
 public:
  /// @throws std::invalid_argument  a length, speed or time is negative or not finite
  explicit ObjectPath(const ObjectParameters& parameters);

  /// @param t  simulated time [s], from 0
  [[nodiscard]] ObjectState at(double t) const;

  /// Puts it, and what hides it, into a scene.
  /// @param T_U0  base of its arm in the world
  void add_to(camera::Scene& scene, const Pose& T_U0, const ObjectState& state) const;

 private:
  struct Wave {
    double frequency, phase, share;
  };
  static constexpr std::size_t kWaves = 3;
  static constexpr std::size_t kAxes = 4;  // x, y, z, about z

  [[nodiscard]] double travelled(double t, double length) const;
  [[nodiscard]] std::array<double, kAxes> wander(double t) const;

  ObjectParameters p_;
  std::array<std::array<Wave, kWaves>, kAxes> waves_{};
  camera::Scene plate_;  // the object in G
};

}  // namespace mrroc::sim
