#include "sim/bullet/multibody.hpp"

#include <BulletDynamics/Featherstone/btMultiBodyLink.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/bullet/convert.hpp"

namespace mrroc::sim {
namespace {

constexpr double kSliderMass = 0.02;     // of a link that only gives way [kg]
constexpr double kSliderInertia = 1e-4;  // of it and of a jaw [kg m^2]

struct LinkPlan {
  std::string name;
  bool fixed{}, prismatic{};
  int back{1};  // the parent is so many links before
  Pose T_PL;    // link frame in that of the link before, joint at zero
  Vector3 axis{Vector3::Zero()};
  double mass{};
  Vector3 mass_centre{Vector3::Zero()}, inertia{Vector3::Zero()};
};

struct Plan {
  std::vector<LinkPlan> links;
  std::vector<BodyShape> shapes;  // T_GV is still in the frame of the description's link
  Pose T_WS, T_WT, T_TE;          // W wrist, S sensor, T tool, E its tip
  int joints{};
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

LinkPlan plan_link(const urdf::Joint& joint, const urdf::Link& link, const Pose& T_PL) {
  LinkPlan plan;
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
void plan_shapes(Plan& plan, const urdf::Link& link, int body, const Pose& T) {
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
    plan.shapes.push_back(s);
  }
}

Plan plan_chain(const urdf::ModelInterface& model, std::span<const robots::LinkLength> lengths) {
  Plan plan;
  Pose T;  // of the present link in the last link that moves by itself
  bool at_tool = false;
  plan_shapes(plan, *model.getRoot(), -1, T);
  for (auto link = model.getRoot(); !link->child_joints.empty(); link = link->child_links.front()) {
    if (link->child_joints.size() != 1) refuse("link " + link->name + " has several children");
    const urdf::Joint& joint = *link->child_joints.front();
    const urdf::Link& child = *link->child_links.front();
    T = T * place_of(joint, lengths);
    if (joint.name == "sensor") plan.T_WS = T;
    if (child.name == "tool") plan.T_WT = T;
    if (child.name == "pen_tip" && at_tool) plan.T_TE = T;
    if (joint.type == urdf::Joint::FIXED && child.name != "tool") {
      plan_shapes(plan, child, static_cast<int>(plan.links.size()) - 1, T);
      continue;
    }
    if (at_tool) refuse("joint " + joint.name + " is beyond the tool");
    at_tool = child.name == "tool";
    plan.links.push_back(plan_link(joint, child, T));
    plan.joints += !at_tool;
    T = Pose();
    plan_shapes(plan, child, static_cast<int>(plan.links.size()) - 1, T);
  }
  if (!at_tool) refuse("there is no link named tool");
  return plan;
}

/// Makes links as they really are.
void apply(Plan& plan, const LinkError& error) {
  for (LinkPlan& link : plan.links) {
    if (link.name != error.link) continue;
    if (!(error.mass_scale > 0)) refuse("the mass of link " + link.name + " is not positive");
    link.mass *= error.mass_scale;
    link.inertia *= error.mass_scale;
    link.mass_centre += error.mass_centre_error;
    if (&link == &plan.links.back()) plan.T_TE.p += error.tip_error;
  }
}

std::shared_ptr<const urdf::ModelInterface> parsed(std::string_view urdf) {
  auto model = urdf::parseURDF(std::string(urdf));
  if (!model) refuse("it is not URDF");
  return model;
}

LinkPlan slider(const Vector3& axis, const Vector3& place, double mass, int back) {
  LinkPlan link;
  link.prismatic = true;
  link.back = back;
  link.T_PL.p = place;
  link.axis = axis;
  link.mass = mass;
  link.inertia.setConstant(kSliderInertia);
  return link;
}

/// Lets the tool give way, and gives it jaws.
void add_gripper(Plan& plan, const GripperBodyParameters& p) {
  LinkPlan tool = plan.links.back();
  plan.links.pop_back();
  const Pose T_PW = tool.T_PL;
  for (const Vector3 axis : {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()})
    plan.links.push_back(slider(axis, Vector3::Zero(), kSliderMass, 1));
  plan.links[plan.links.size() - ArmBody::kWristAxes].T_PL = T_PW;

  const Vector3 jaws = 2 * p.jaw_mass * plan.T_TE.p;
  if (!(tool.mass > 2 * p.jaw_mass)) refuse("the jaws are heavier than the tool");
  tool.mass_centre = (tool.mass * tool.mass_centre - jaws) / (tool.mass - 2 * p.jaw_mass);
  tool.mass -= 2 * p.jaw_mass;
  tool.T_PL = Pose();
  plan.links.push_back(tool);
  const Vector3 pad(0, p.pad_thickness / 2, 0);
  plan.links.push_back(slider(Vector3::UnitY(), plan.T_TE.p + pad, p.jaw_mass, 1));
  plan.links.push_back(slider(-Vector3::UnitY(), plan.T_TE.p - pad, p.jaw_mass, 2));
}

void set_up_link(btMultiBody& body, const Plan& plan, std::size_t k, double rotor_inertia) {
  const LinkPlan& link = plan.links[k];
  const int index = static_cast<int>(k);
  const int parent = index - link.back;
  const btQuaternion to_link = quaternion(link.T_PL.R.transpose());
  const Vector3 from_parent =
      parent < 0 ? link.T_PL.p : link.T_PL.p - plan.links[static_cast<std::size_t>(parent)].mass_centre;
  const btVector3 pivot = to_bullet(from_parent);
  const btVector3 centre = to_bullet(link.mass_centre);
  if (link.fixed) {
    body.setupFixed(index, link.mass, to_bullet(link.inertia), parent, to_link, pivot, centre);
  } else if (link.prismatic) {
    body.setupPrismatic(index, link.mass + rotor_inertia, to_bullet(link.inertia), parent, to_link,
                        to_bullet(link.axis), pivot, centre, true);
  } else {
    const Vector3 inertia = link.inertia + rotor_inertia * link.axis.cwiseAbs2();
    body.setupRevolute(index, link.mass, to_bullet(inertia), parent, to_link, to_bullet(link.axis), pivot,
                       centre, true);
  }
}

}  // namespace

std::vector<robots::LinkLength> lengths_of(const robots::RobotType& type, int model) {
  return type.lengths ? type.lengths(model) : std::vector<robots::LinkLength>();
}

std::vector<std::string> link_names(const robots::RobotType& type) {
  std::vector<std::string> names;
  for (const LinkPlan& link : plan_chain(*parsed(type.urdf), {}).links) names.push_back(link.name);
  return names;
}

ArmBody build_arm(std::string_view urdf, std::span<const robots::LinkLength> lengths, const Pose& T_UB,
                  const AxisVector& rotor_inertia, const std::optional<ToolMass>& tool,
                  const std::optional<GripperBodyParameters>& gripper, std::span<const LinkError> errors) {
  Plan plan = plan_chain(*parsed(urdf), lengths);
  if (tool) {
    LinkPlan& link = plan.links.back();
    if (!(tool->mass > 0) || !tool->centre.allFinite()) refuse("the tool has no mass");
    link.inertia *= tool->mass / link.mass;
    link.mass = tool->mass;
    link.mass_centre = tool->centre;  // the tool's frame is W
  }
  for (const LinkError& error : errors) apply(plan, error);
  if (gripper) add_gripper(plan, *gripper);
  if (plan.joints != rotor_inertia.size()) refuse("it has another number of joints than the robot");

  ArmBody arm;
  arm.joints = plan.joints;
  arm.tool = plan.joints + (gripper ? ArmBody::kWristAxes : 0);
  const int links = static_cast<int>(plan.links.size());
  arm.body = std::make_unique<btMultiBody>(links, 0, btVector3(0, 0, 0), true, false);
  arm.body->setBasePos(to_bullet(T_UB.p));
  arm.body->setWorldToBaseRot(quaternion(T_UB.R.transpose()));
  for (std::size_t k = 0; k < plan.links.size(); ++k)
    set_up_link(*arm.body, plan, k,
                k < static_cast<std::size_t>(plan.joints) ? rotor_inertia[static_cast<int>(k)] : 0);
  arm.body->finalizeMultiDof();
  arm.body->setCanSleep(false);
  arm.body->setHasSelfCollision(false);
  arm.body->setUseGyroTerm(true);
  arm.body->setLinearDamping(0);
  arm.body->setAngularDamping(0);

  const Pose T_TG{Matrix3::Identity(), plan.links[static_cast<std::size_t>(arm.tool)].mass_centre};
  arm.T_GS = T_TG.inverse() * plan.T_WT.inverse() * plan.T_WS;
  arm.T_GE = T_TG.inverse() * plan.T_TE;
  arm.shapes = std::move(plan.shapes);
  for (BodyShape& s : arm.shapes) {
    if (s.body == arm.joints) s.body = arm.tool;
    if (s.body >= 0) s.T_GV.p -= plan.links[static_cast<std::size_t>(s.body)].mass_centre;
  }
  return arm;
}

void set_joints(btMultiBody& body, const AxisVector& joints) {
  for (int k = 0; k < joints.size(); ++k) {
    body.setJointPos(k, joints[k]);
    body.setJointVel(k, 0);
  }
  btAlignedObjectArray<btQuaternion> rotations;
  btAlignedObjectArray<btVector3> origins;
  body.forwardKinematics(rotations, origins);
  body.updateCollisionObjectWorldTransforms(rotations, origins);
}

Pose link_pose(const btMultiBody& body, int link) {
  return from_bullet(body.getLink(link).m_cachedWorldTransform);
}

}  // namespace mrroc::sim
