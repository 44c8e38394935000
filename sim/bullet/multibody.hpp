// An arm's links and joints as one Bullet multibody, built from its URDF description.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/axes.hpp"
#include "base/pose.hpp"
#include "base/shape.hpp"
#include "robots/catalogue.hpp"
#include "sim/gripper_body.hpp"
#include "sim/link_error.hpp"

namespace mrroc::sim {

/// A shape of the description's visual part.
struct BodyShape {
  std::string link;               ///< its name
  int body{-1};                   ///< index of the multibody's link that it moves with; -1: the base
  Shape shape{};                  ///< its form
  Vector3 size{Vector3::Zero()};  ///< [m]
  Pose T_GV;                      ///< its middle in the frame of that link, whose origin is the mass centre
};

/// The multibody and the frames on it that matter. Links 0..joints-1 are moved by the joints in the order of
/// the description, link `tool` is everything beyond the joint "sensor". With a gripper three links of the elastic wrist
/// lie before the tool, which give way along z, y and x of W counted from the tool, and the two jaws behind it.
struct ArmBody {
  static constexpr int kWristAxes = 3;  ///< links of the elastic wrist

  std::unique_ptr<btMultiBody> body;  ///< never null
  int joints{};                       ///< number of moving joints
  int tool{};                         ///< index of the tool's link
  Pose T_GS;  ///< sensor in the frame of the tool's link; its origin G is the tool's mass centre
  Pose T_GE;  ///< tip of the tool, or E of the gripper, in the frame of the tool's link
  std::vector<BodyShape> shapes;  ///< what it looks like
};

/// Mass of a tool and its centre in W.
struct ToolMass {
  double mass{};                    ///< [kg], > 0
  Vector3 centre{Vector3::Zero()};  ///< in W [m]
};

/// @param urdf           serial chain: moving joints, a fixed joint "sensor", a link "tool" with mass, a link
/// "pen_tip"
/// @param lengths        take the place of the description's, along the same directions; masses and their centres stay
/// @param T_UB           base of the arm in the world
/// @param rotor_inertia  of each motor as felt at its joint [kg m^2], track: [kg]; added to the link about
/// (along)
///                       the joint's axis
/// @param tool  instead of the described mass of the tool; its inertia grows with its mass
/// @param gripper  its jaws are part of the tool's mass; none: the tool has no jaws that touch anything
/// @param errors   of links, and of the tool, whatever its mass is
/// @throws std::invalid_argument  the description is not such a chain
ArmBody build_arm(std::string_view urdf, std::span<const robots::LinkLength> lengths, const Pose& T_UB,
                  const AxisVector& rotor_inertia, const std::optional<ToolMass>& tool = {},
                  const std::optional<GripperBodyParameters>& gripper = {},
                  std::span<const LinkError> errors = {});

/// @return the lengths of a kinematic model of a robot that its description has otherwise
std::vector<robots::LinkLength> lengths_of(const robots::RobotType& type, int model);

/// Moves the joints and everything that is computed from them; at rest.
/// @param joints [rad, track m]
void set_joints(btMultiBody& body, const AxisVector& joints);

/// @return pose of a link's mass centre in the world, axes as in the description
Pose link_pose(const btMultiBody& body, int link);

}  // namespace mrroc::sim
