// Teach-in: poses, or poses and forces, recorded while an arm is led, kept in a file, and executed again.
#pragma once
#include <filesystem>
#include <vector>

#include "ecp/generators/polynomials.hpp"
#include "ecp/generators/trajectory.hpp"

namespace mrroc::ecp {

/// One recorded moment.
struct TaughtPose {
  double t{};        ///< [s] since the first one
  Coordinates pose;  ///< in the space of the recording
  Wrench F{};        ///< F_a in E then [N, N m]
};

/// A recording. Its space is that of all poses.
struct TaughtPath {
  Representation space{Representation::xyz_angle_axis};  ///< any but frame
  Reference reference{Reference::absolute};              ///< relative: each pose is seen from the first one
  bool with_force{};                                     ///< the forces F were recorded, too
  std::vector<TaughtPose> poses;                         ///< in the order of their times
};

/// A recording in the making, part of a memory c_c: a value to which poses can only be appended. Versions
/// share one buffer, of which each sees its first size() poses; they must not be used by two threads at once.
class TeachIn {
 public:
  TeachIn() = default;
  /// @param axes  of the robot; counts for motors and joints
  TeachIn(Representation space, Reference reference, bool with_force, int axes);

  /// @param reply  of the effector; its numbers must be in the recording's space (get_representation)
  /// @param t      [s], later than the one before; the first one becomes 0
  /// @return this recording with one pose more; this one stays as it is. O(1) amortised for the newest
  /// version
  [[nodiscard]] TeachIn appended(const EffectorReply& reply, double t) const;

  /// @return number of poses
  [[nodiscard]] std::size_t size() const { return size_; }
  /// @return the recording, to be saved or executed
  [[nodiscard]] TaughtPath path() const;

 private:
  [[nodiscard]] Coordinates seen_from_first(const Coordinates& pose) const;

  Representation space_{Representation::xyz_angle_axis};
  Reference reference_{Reference::absolute};
  bool with_force_{};
  int numbers_{6};
  double first_t_{};
  Coordinates first_;
  std::shared_ptr<std::vector<TaughtPose>> poses_;
  std::size_t size_{};
};

/// A recording as f' needs it: a trajectory, and the force that belongs to each of its macrosteps.
class Replay {
 public:
  Replay() = default;
  /// @param taught  at least two poses  @param mu  mim, or tcim_pose, which forces need
  /// @throws FaultError bad_trajectory
  Replay(const TaughtPath& taught, Interpolation mu, const Pacing& pacing = {});

  /// @return the poses, joined by straight lines of the space
  [[nodiscard]] const Trajectory& path() const { return path_; }
  /// @param k  macrosteps executed before
  /// @return the force in E when macrostep k ends; none when none was recorded
  [[nodiscard]] Wrench force(std::int64_t k) const;
  /// @return the command of macrostep k. Along and about the axes that are CONTACT in `rows`, F_d is the
  ///         recorded force instead of the pose; everything else of `rows` stands
  [[nodiscard]] ArmCommand command(std::int64_t k, const TaskFrameCommand& rows) const;

 private:
  Trajectory path_;
  Trajectory force_;
};

/// Writes a recording. Lines, fields separated by one space:
///
///     mrroc-trajectory 1            format and its version
///     space joints                  motors, joints, xyz_euler_zyz or xyz_angle_axis
///     reference absolute            or relative
///     numbers 6                     per pose
///     force no                      yes: six components of F_a in E follow each pose
///     poses N
///     t q1 q2 ... [Fx Fy Fz Nx Ny Nz]       N rows: time [s], pose, force [N, N m]
///     end
///
/// Numbers have 17 significant digits, so that they come back bit by bit.
/// @throws FaultError cannot_write; FileError  a number is not finite
void save(const std::filesystem::path& file, const TaughtPath& taught);

/// Reads what save writes.
/// @throws FileError  naming file and line: another format or version, an unknown word, a wrong count, a
///         number that is not finite, time that does not rise, a truncated file or text behind its end
[[nodiscard]] TaughtPath load_taught_path(const std::filesystem::path& file);

}  // namespace mrroc::ecp
