#include "test/robots/irb6/model.hpp"

#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <vector>

namespace mrroc::irb6::test {
namespace {

KDL::Frame origin_of(const urdf::Joint& joint) {
  const urdf::Pose& o = joint.parent_to_joint_origin_transform;
  return {KDL::Rotation::Quaternion(o.rotation.x, o.rotation.y, o.rotation.z, o.rotation.w),
          KDL::Vector(o.position.x, o.position.y, o.position.z)};
}

KDL::Joint joint_of(const urdf::Joint& joint) {
  const KDL::Frame f = origin_of(joint);
  const KDL::Vector axis = f.M * KDL::Vector(joint.axis.x, joint.axis.y, joint.axis.z);
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return {joint.name, f.p, axis, KDL::Joint::RotAxis};
    case urdf::Joint::PRISMATIC:
      return {joint.name, f.p, axis, KDL::Joint::TransAxis};
    default:
      return KDL::Joint(joint.name, KDL::Joint::None);
  }
}

}  // namespace

urdf::ModelInterfaceSharedPtr read_model(const std::string& name) {
  return urdf::parseURDFFile(std::string(MRROC_SOURCE_DIR) + "/robots/irb6/" + name + ".urdf");
}

KDL::Chain chain_to(const urdf::ModelInterface& model, const std::string& tip) {
  std::vector<KDL::Segment> reversed;
  for (auto link = model.getLink(tip); link->parent_joint;
       link = model.getLink(link->parent_joint->parent_link_name))
    reversed.emplace_back(link->name, joint_of(*link->parent_joint), origin_of(*link->parent_joint));
  KDL::Chain chain;
  std::for_each(reversed.rbegin(), reversed.rend(), [&](const KDL::Segment& s) { chain.addSegment(s); });
  return chain;
}

Pose forward(const KDL::Chain& chain, const AxisVector& joints) {
  KDL::JntArray q(static_cast<unsigned>(joints.size()));
  q.data = joints;
  KDL::Frame f;
  KDL::ChainFkSolverPos_recursive(chain).JntToCart(q, f);
  Pose T;
  for (int r = 0; r < 3; ++r) {
    T.p[r] = f.p[r];
    for (int c = 0; c < 3; ++c) T.R(r, c) = f.M(r, c);
  }
  return T;
}

KDL::Frame to_kdl(const Pose& T) {
  KDL::Frame f;
  for (int r = 0; r < 3; ++r) {
    f.p[r] = T.p[r];
    for (int c = 0; c < 3; ++c) f.M(r, c) = T.R(r, c);
  }
  return f;
}

}  // namespace mrroc::irb6::test
