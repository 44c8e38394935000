#include "sim/bullet/arm_at_rest.hpp"

#include <Eigen/Dense>
#include <vector>

#include "sim/bullet/convert.hpp"

namespace mrroc::sim {
namespace {

/// Finds accelerations of a body's freedoms under the forces that it has.
class Accelerations {
 public:
  explicit Accelerations(btMultiBody& body) : body_(body) {
    for (int link = 0; link < body.getNumLinks(); ++link)
      if (body.getLink(link).m_dofCount > 0) links_.push_back(link);
  }
  /// @return links that move by themselves
  [[nodiscard]] const std::vector<int>& links() const { return links_; }

  /// @return of each of those [rad/s^2], [m/s^2]; forces are gone and the body is at rest again
  Eigen::VectorXd take() {
    constexpr double kShort = 1e-3;  // [s]; Bullet limits speeds
    body_.computeAccelerationsArticulatedBodyAlgorithmMultiDof(kShort, numbers_, vectors_, matrices_, false,
                                                               false, false);
    Eigen::VectorXd found(static_cast<Eigen::Index>(links_.size()));
    for (Eigen::Index k = 0; k < found.size(); ++k) {
      const int link = links_[static_cast<std::size_t>(k)];
      found[k] = body_.getJointVel(link) / kShort;
      body_.setJointVel(link, 0);
    }
    body_.clearForcesAndTorques();
    return found;
  }

 private:
  btMultiBody& body_;
  std::vector<int> links_;
  btAlignedObjectArray<btScalar> numbers_;
  btAlignedObjectArray<btVector3> vectors_;
  btAlignedObjectArray<btMatrix3x3> matrices_;
};

}  // namespace

ArmAtRest arm_at_rest(const ArmBody& arm, const Vector3& gravity) {
  btMultiBody& body = *arm.body;
  body.clearForcesAndTorques();
  Accelerations accelerations(body);
  const auto n = static_cast<Eigen::Index>(accelerations.links().size());
  Eigen::MatrixXd inverse(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    body.addJointTorque(accelerations.links()[static_cast<std::size_t>(k)], 1);
    inverse.col(k) = accelerations.take();
  }
  for (int link = 0; link < body.getNumLinks(); ++link)
    body.addLinkForce(link, to_bullet(Vector3(body.getLinkMass(link) * gravity)));
  const Eigen::VectorXd falling = accelerations.take();

  const Eigen::MatrixXd mass = inverse.inverse();
  ArmAtRest rest;
  rest.joints.resize(arm.joints);
  for (int k = 0; k < arm.joints; ++k) rest.joints[k] = body.getJointPos(k);
  rest.mass = ((mass + mass.transpose()) / 2).topLeftCorner(arm.joints, arm.joints);
  rest.holding = -(mass * falling).head(arm.joints);
  return rest;
}

}  // namespace mrroc::sim
