#include "sim/chain.hpp"

#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <stdexcept>

namespace mrroc::sim {
namespace {

constexpr double kSliderMass = 0.02;     // of a link that only gives way [kg]
constexpr double kSliderInertia = 1e-4;  // of it and of a jaw [kg m^2]

/// Links, their number of joints and shapes are in the chain; T_GV of a shape is still in the frame of its link.
struct Plan {
  Chain chain;
  Pose T_WS, T_WT, T_TE;                  // W wrist, S sensor, T tool, E its tip
  Matrix3 tip_turn{Matrix3::Identity()};  // of E and what is fixed to it, from the description
};

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("robot description: " + what);
}

Pose pose_of(const urdf::Pose& p) {
  const Eigen::Quaterniond q(p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z);
  return {q.toRotationMatrix(), {p.position.x, p.position.y, p.position.z}};
}

/// @return where a joint stands in the link before, as the arm's lengths have it
Pose place_of(const urdf::Joint& joint, std::span<const robots::LinkLength> lengths) {
  Pose T = pose_of(joint.parent_to_joint_origin_transform);
  for (const auto& [name, length] : lengths)
    if (joint.name == name) T.p *= length / T.p.norm();
  return T;
}

ChainLink plan_link(const urdf::Joint& joint, const urdf::Link& link, const Pose& T_PL) {
  ChainLink plan;
  plan.name = link.name;
  plan.fixed = joint.type == urdf::Joint::FIXED;
  plan.prismatic = joint.type == urdf::Joint::PRISMATIC;
  plan.T_PL = T_PL;
  plan.axis = {joint.axis.x, joint.axis.y, joint.axis.z};
  const auto& inertial = link.inertial;
  if (!inertial || inertial->mass <= 0) refuse("link " + link.name + " has no mass");
  if (inertial->ixy != 0 || inertial->ixz != 0 || inertial->iyz != 0)
    refuse("link " + link.name + " has products of inertia");
  plan.mass = inertial->mass;
  plan.mass_centre = pose_of(inertial->origin).p;
  plan.inertia = {inertial->ixx, inertial->iyy, inertial->izz};
  return plan;
}

/// @param T  of the link in the frame of the link `body` that it moves with
void plan_shapes(Chain& chain, const urdf::Link& link, int body, const Pose& T) {
  for (const auto& visual : link.visual_array) {
    if (!visual || !visual->geometry) continue;
    BodyShape s{link.name, body, {}, {}, T * pose_of(visual->origin)};
    const urdf::Geometry& g = *visual->geometry;
    if (g.type == urdf::Geometry::BOX) {
      const auto& box = static_cast<const urdf::Box&>(g);
      s.shape = Shape::box;
      s.size = {box.dim.x, box.dim.y, box.dim.z};
    } else if (g.type == urdf::Geometry::CYLINDER) {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(g);
      s.shape = Shape::cylinder;
      s.size = {2 * cylinder.radius, 2 * cylinder.radius, cylinder.length};
    } else if (g.type == urdf::Geometry::SPHERE) {
      s.shape = Shape::sphere;
      s.size.setConstant(2 * static_cast<const urdf::Sphere&>(g).radius);
    } else {
      refuse("the visual part of link " + link.name + " is no box, cylinder or sphere");
    }
    chain.shapes.push_back(s);
  }
}

Plan plan_chain(const urdf::ModelInterface& model, std::span<const robots::LinkLength> lengths) {
  Plan plan;
  Pose T;  // of the present link in the last link that moves by itself
  bool at_tool = false;
  plan_shapes(plan.chain, *model.getRoot(), -1, T);
  for (auto link = model.getRoot(); !link->child_joints.empty(); link = link->child_links.front()) {
    if (link->child_joints.size() != 1) refuse("link " + link->name + " has several children");
    const urdf::Joint& joint = *link->child_joints.front();
    const urdf::Link& child = *link->child_links.front();
    T = T * place_of(joint, lengths);
    if (joint.name == "sensor") plan.T_WS = T;
    if (child.name == "tool") plan.T_WT = T;
    if (child.name == "pen_tip" && at_tool) plan.T_TE = T;
    if (joint.type == urdf::Joint::FIXED && child.name != "tool") {
      plan_shapes(plan.chain, child, static_cast<int>(plan.chain.links.size()) - 1, T);
      continue;
    }
    if (at_tool) refuse("joint " + joint.name + " is beyond the tool");
    at_tool = child.name == "tool";
    plan.chain.links.push_back(plan_link(joint, child, T));
    plan.chain.joints += !at_tool;
    T = Pose();
    plan_shapes(plan.chain, child, static_cast<int>(plan.chain.links.size()) - 1, T);
  }
  if (!at_tool) refuse("there is no link named tool");
  return plan;
}

/// Makes links as they really are.
void apply(Plan& plan, const LinkError& error) {
  for (ChainLink& link : plan.chain.links) {
    if (link.name != error.link) continue;
    if (!(error.mass_scale > 0)) refuse("the mass of link " + link.name + " is not positive");
    link.mass *= error.mass_scale;
    link.inertia *= error.mass_scale;
    link.mass_centre += error.mass_centre_error;
    link.zero_error += error.zero_error;
    if (&link != &plan.chain.links.back()) continue;
    plan.T_TE.p += error.tip_error;
    if (error.tip_turn.isZero(0)) continue;
    plan.tip_turn = rotation_from_angle_axis(error.tip_turn);
    plan.T_TE.R = plan.tip_turn * plan.T_TE.R;
  }
}

std::shared_ptr<const urdf::ModelInterface> parsed(std::string_view urdf) {
  auto model = urdf::parseURDF(std::string(urdf));
  if (!model) refuse("it is not URDF");
  return model;
}

ChainLink slider(const Vector3& axis, const Pose& place, double mass, int back) {
  ChainLink link;
  link.prismatic = true;
  link.back = back;
  link.T_PL = place;
  link.axis = axis;
  link.mass = mass;
  link.inertia.setConstant(kSliderInertia);
  return link;
}

/// Lets the tool give way, and gives it jaws.
void add_gripper(Plan& plan, const GripperBodyParameters& p) {
  std::vector<ChainLink>& links = plan.chain.links;
  ChainLink tool = links.back();
  links.pop_back();
  const Pose T_PW = tool.T_PL;
  for (const Vector3 axis : {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()})
    links.push_back(slider(axis, Pose(), kSliderMass, 1));
  links[links.size() - Chain::kWristAxes].T_PL = T_PW;

  const Vector3 jaws = 2 * p.jaw_mass * plan.T_TE.p;
  if (!(tool.mass > 2 * p.jaw_mass)) refuse("the jaws are heavier than the tool");
  tool.mass_centre = (tool.mass * tool.mass_centre - jaws) / (tool.mass - 2 * p.jaw_mass);
  tool.mass -= 2 * p.jaw_mass;
  tool.T_PL = Pose();
  links.push_back(tool);
  const Vector3 pad = plan.tip_turn * Vector3(0, p.pad_thickness / 2, 0);
  const auto jaw = [&](const Vector3& axis, const Vector3& from_tip, int back) {
    links.push_back(slider(axis, {plan.tip_turn, plan.T_TE.p + from_tip}, p.jaw_mass, back));
  };
  jaw(Vector3::UnitY(), pad, 1);
  jaw(-Vector3::UnitY(), -pad, 2);
}

void add_rotor(ChainLink& link, double inertia) {
  if (link.prismatic)
    link.mass += inertia;
  else
    link.inertia += inertia * link.axis.cwiseAbs2();
}

void change_tool(ChainLink& link, const ToolMass& tool) {
  if (!(tool.mass > 0) || !tool.centre.allFinite()) refuse("the tool has no mass");
  link.inertia *= tool.mass / link.mass;
  link.mass = tool.mass;
  link.mass_centre = tool.centre;  // the tool's frame is W
}

}  // namespace

std::vector<robots::LinkLength> lengths_of(const robots::RobotType& type, int model) {
  return type.lengths ? type.lengths(model) : std::vector<robots::LinkLength>();
}

std::vector<std::string> link_names(const robots::RobotType& type) {
  std::vector<std::string> names;
  for (const ChainLink& link : plan_chain(*parsed(type.urdf), {}).chain.links) names.push_back(link.name);
  return names;
}

Chain read_chain(std::string_view urdf, std::span<const robots::LinkLength> lengths,
                 const AxisVector& rotor_inertia, const std::optional<ToolMass>& tool,
                 const std::optional<GripperBodyParameters>& gripper, std::span<const LinkError> errors) {
  Plan plan = plan_chain(*parsed(urdf), lengths);
  Chain& chain = plan.chain;
  if (tool) change_tool(chain.links.back(), *tool);
  for (const LinkError& error : errors) apply(plan, error);
  if (gripper) add_gripper(plan, *gripper);
  if (chain.joints != rotor_inertia.size()) refuse("it has another number of joints than the robot");
  for (int k = 0; k < chain.joints; ++k)
    add_rotor(chain.links[static_cast<std::size_t>(k)], rotor_inertia[k]);

  chain.tool = chain.joints + (gripper ? Chain::kWristAxes : 0);
  const Pose T_TG{Matrix3::Identity(), chain.links[static_cast<std::size_t>(chain.tool)].mass_centre};
  chain.T_GS = T_TG.inverse() * plan.T_WT.inverse() * plan.T_WS;
  chain.T_GE = T_TG.inverse() * plan.T_TE;
  for (BodyShape& s : chain.shapes) {
    if (s.body == chain.joints) s.body = chain.tool;
    if (s.body >= 0) s.T_GV.p -= chain.links[static_cast<std::size_t>(s.body)].mass_centre;
  }
  return std::move(plan.chain);
}

}  // namespace mrroc::sim
