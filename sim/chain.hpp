// An arm's links and joints, from its URDF description: what an engine builds the arm's bodies from.
#pragma once
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
  int body{-1};                   ///< index of the chain's link that it moves with; -1: the base
  Shape shape{};                  ///< its form
  Vector3 size{Vector3::Zero()};  ///< [m]
  Pose T_GV;                      ///< its middle in the frame of that link, whose origin is the mass centre
};

/// A link and the joint that moves it.
struct ChainLink {
  std::string name;               ///< in the description; empty: it only gives way, or is a jaw
  bool fixed{};                   ///< it moves with the link before
  bool prismatic{};               ///< its joint is a slider; otherwise it turns, unless it is fixed
  int back{1};                    ///< the parent is so many links before; the base is before the first one
  Pose T_PL;                      ///< frame of the link in that of its parent, the joint at zero
  Vector3 axis{Vector3::Zero()};  ///< of the joint, in the link, through its origin
  double zero_error{};  ///< true position of the joint less what its encoder is taken for [rad], slider [m]
  double mass{};        ///< [kg], the rotor of a slider's motor included
  Vector3 mass_centre{Vector3::Zero()};  ///< in the link [m]
  Vector3 inertia{Vector3::Zero()};  ///< about the mass centre and the link's axes, rotor included [kg m^2]
};

/// Links 0..joints-1 are moved by the joints in the order of the description, link `tool` is everything beyond the joint
/// "sensor". With a gripper three links of the elastic wrist lie before the tool, which give way along z, y and x of W
/// counted from the tool, and the two jaws behind it.
struct Chain {
  static constexpr int kWristAxes = 3;  ///< links of the elastic wrist

  std::vector<ChainLink> links;   ///< a parent is before its children
  int joints{};                   ///< number of joints that motors move
  int tool{};                     ///< index of the tool's link
  Pose T_GS;                      ///< sensor in the tool's link; its origin G is the tool's mass centre
  Pose T_GE;                      ///< tip of the tool, or E of the gripper, in the tool's link, as above
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
/// @param rotor_inertia  of each motor as felt at its joint [kg m^2], track: [kg]; added to the link about
/// (along)
///                       the joint's axis
/// @param tool  instead of the described mass of the tool; its inertia grows with its mass
/// @param gripper  its jaws are part of the tool's mass; none: the tool has no jaws that touch anything
/// @param errors   of links, and of the tool, whatever its mass is
/// @throws std::invalid_argument  the description is not such a chain
[[nodiscard]] Chain read_chain(std::string_view urdf, std::span<const robots::LinkLength> lengths,
                               const AxisVector& rotor_inertia, const std::optional<ToolMass>& tool = {},
                               const std::optional<GripperBodyParameters>& gripper = {},
                               std::span<const LinkError> errors = {});

/// @return the lengths of a kinematic model of a robot that its description has otherwise
[[nodiscard]] std::vector<robots::LinkLength> lengths_of(const robots::RobotType& type, int model);

}  // namespace mrroc::sim
