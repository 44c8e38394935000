// The file that `./run move --file` executes: motions of arms, each by one generator through positions in one representation.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/effector_command.hpp"
#include "base/spatial.hpp"
#include "ecp/generators/curve.hpp"
#include "ecp/generators/straight_path.hpp"

namespace mrroc::any_motion {

/// Positions of one motion, at most.
inline constexpr std::size_t kMostPositions = 2000;

/// Generators of ecp/generators by which a motion can be made.
enum class Generator : std::uint8_t {
  trapezoid,
  polyline,
  linear,
  cubic,
  quintic,
  nurbs,
  straight,
  constant,
  hold,
  replay
};

/// One motion of an arm, as it is written. Which members count depends on the generator.
struct MotionSpec {
  std::string name;                           ///< ARM.MOTION, for errors
  Generator generator{Generator::trapezoid};  ///< how the positions are joined
  Representation space{
      Representation::joints};               ///< of the positions as they are written and sent (MG tab. 1)
  Reference reference{Reference::absolute};  ///< relative: each position is seen from the one before
  Interpolation mu{Interpolation::mim};      ///< mim or tcim_pose
  /// Where the motion leads; it begins where the one before has ended. Motors [rad], joints [rad, track m], or x, y, z [m]
  /// and three angles [rad]: what is written as a matrix, and what a straight line leads to, is angle-axis here.
  std::vector<ecp::Coordinates> positions;
  std::vector<double> times;     ///< when each position is reached [s]; empty: as fast as the shares permit
  std::vector<double> velocity;  ///< shares of the limits, above 0 up to 1: one, or one per position
  std::vector<double> acceleration;  ///< the same
  bool pass{};                       ///< goes through the positions without stopping
  double duration{};                 ///< hold, nurbs: [s]; nurbs, 0: as fast as the shares permit
  int degree{3};                     ///< nurbs
  std::vector<double>
      weights;  ///< nurbs: of its control points, of which the first is where it begins; empty: all 1
  std::vector<double> knots;   ///< nurbs; empty: evenly spaced
  ecp::PathLimits path;        ///< straight
  std::vector<Wrench> forces;  ///< replay: F_a in E at each position; empty: none
  std::vector<Axis> contact;   ///< replay: axes along which the force is repeated, and not the position

  /// @return coordinates of `positions`, in which it is planned
  [[nodiscard]] Representation planned() const {
    const bool rotates = space == Representation::frame || generator == Generator::straight;
    return rotates ? Representation::xyz_angle_axis : space;
  }
};

/// What one arm is to do.
struct ArmMotions {
  std::string arm;  ///< its key
  std::optional<ecp::Coordinates>
      start;  ///< joints to which it goes first [rad, track m]; nothing: its usual ones
  std::vector<MotionSpec>
      motions;  ///< one after another; empty: it goes to its start, if there is one, and rests

  /// @return whether the arm moves at all
  [[nodiscard]] bool moves() const { return start || !motions.empty(); }
};

/// A whole file.
struct MotionFile {
  bool together{};               ///< the arms begin each motion at the same time, and end it at the same time
  std::vector<ArmMotions> arms;  ///< of all arms of the cell, in their order
};

/// An arm of the cell, as far as the file depends on it.
struct ArmKey {
  std::string key;          ///< arm1
  std::optional<int> axes;  ///< nothing: not known yet, and the count of numbers is not looked at
};

/// @param text  what is wrong with it @return the error of a value that is there, at the place where it stands
[[nodiscard]] ConfigError wrong_value(const Config& config, std::string_view key, const std::string& text);

/// Reads
///     together = false            # arms begin their motions at the same time, and take the same time
///     [ARM]                       # of each arm that is to move
///     start = [...]               # joints, one per axis; default: where the arm usually stands
///     order = ["NAME", ...]       # motions one after another; one may be named several times
///     [ARM.NAME]                  # a motion: generator, space, reference, interpolation, positions, and what the generator takes
/// tasks/move/README.md has all keys.
/// @param config  a file, or the part of a configuration that holds its keys
/// @throws ConfigError  naming file, line and key
[[nodiscard]] MotionFile read_motions(const Config& config, const std::vector<ArmKey>& arms);

}  // namespace mrroc::any_motion
