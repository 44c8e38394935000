#include "ecp/generators/straight_path.hpp"

#include <fmt/core.h>

#include <kdl/utilities/error.h>
#include <kdl/path_composite.hpp>
#include <kdl/path_line.hpp>
#include <kdl/path_roundedcomposite.hpp>
#include <kdl/rotational_interpolation_sa.hpp>
#include <kdl/trajectory_composite.hpp>
#include <kdl/trajectory_segment.hpp>
#include <kdl/velocityprofile_trap.hpp>

#include "base/fault.hpp"

namespace mrroc::ecp {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw FaultError(FaultCode::bad_trajectory, what); }

KDL::Frame frame_of(const Pose& T) {
  const auto& R = T.R;
  return {KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
          KDL::Vector(T.p.x(), T.p.y(), T.p.z())};
}

Pose pose_of(const KDL::Frame& frame) {
  Pose T;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) T.R(row, column) = frame.M(row, column);
    T.p[row] = frame.p[row];
  }
  return T;
}

Coordinates coordinates_of(const Pose& T) { return angle_axis_from_pose(T); }

/// A path under the trapezoidal speed; takes the path over.
KDL::Trajectory* timed(KDL::Path* path, const PathLimits& limits) {
  auto* const profile = new KDL::VelocityProfile_Trap(limits.velocity, limits.acceleration);
  profile->SetProfile(0, path->PathLength());
  return new KDL::Trajectory_Segment(path, profile);
}

KDL::Trajectory* stopping(const std::vector<Pose>& poses, const PathLimits& limits) {
  auto all = std::make_unique<KDL::Trajectory_Composite>();
  for (std::size_t k = 0; k + 1 < poses.size(); ++k)
    all->Add(timed(new KDL::Path_Line(frame_of(poses[k]), frame_of(poses[k + 1]),
                                      new KDL::RotationalInterpolation_SingleAxis, limits.lever),
                   limits));
  return all.release();
}

KDL::Trajectory* rounded(const std::vector<Pose>& poses, const PathLimits& limits) {
  auto path = std::make_unique<KDL::Path_RoundedComposite>(limits.corner, limits.lever,
                                                           new KDL::RotationalInterpolation_SingleAxis);
  for (const Pose& T : poses) path->Add(frame_of(T));
  path->Finish();
  return timed(path.release(), limits);
}

}  // namespace

struct StraightPath::Impl {
  std::unique_ptr<KDL::Trajectory> trajectory;
  Coordinates end;
};

StraightPath::StraightPath(const std::vector<Pose>& poses, const PathLimits& limits)
    : impl_(std::make_unique<Impl>()) {
  if (poses.size() < 2) refuse("a path needs two poses or more");
  if (!(limits.velocity > 0 && limits.acceleration > 0 && limits.lever > 0 && limits.corner >= 0))
    refuse("limits of a path must be above zero");
  for (const Pose& T : poses)
    if (!is_proper(T)) refuse("a pose of the path is none");
  try {
    const bool stops = limits.corner <= 0 || poses.size() == 2;
    impl_->trajectory.reset(stops ? stopping(poses, limits) : rounded(poses, limits));
  } catch (const KDL::Error& e) {
    refuse(fmt::format("the poses cannot be joined by lines and arcs of {} m: {}", limits.corner,
                       e.Description()));
  }
  impl_->end = coordinates_of(poses.back());
}

StraightPath::~StraightPath() = default;

double StraightPath::duration() const { return impl_->trajectory->Duration(); }

Coordinates StraightPath::at(double t) const {
  if (t >= duration()) return impl_->end;
  return coordinates_of(pose_of(impl_->trajectory->Pos(std::max(0.0, t))));
}

}  // namespace mrroc::ecp
