#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "robots/irb6/arm.hpp"
#include "test/robots/irb6/model.hpp"

namespace mrroc::irb6::test {
namespace {

class GravityOfArm : public testing::TestWithParam<const char*> {};

/// Potential energy of all links of the URDF [J].
class Potential {
 public:
  explicit Potential(const urdf::ModelInterface& model) {
    for (const auto& [name, link] : model.links_)
      if (link->inertial) {
        const urdf::Vector3& c = link->inertial->origin.position;
        links_.push_back({chain_to(model, name), link->inertial->mass, Vector3(c.x, c.y, c.z)});
      }
  }
  [[nodiscard]] double operator()(const AxisVector& joints) const {
    double energy = 0;
    for (const Link& link : links_) {
      const AxisVector moved = joints.head(static_cast<int>(link.chain.getNrOfJoints()));
      energy += 9.81 * link.mass * (forward(link.chain, moved) * link.centre).z();
    }
    return energy;
  }

 private:
  struct Link {
    KDL::Chain chain;
    double mass;
    Vector3 centre;
  };
  std::vector<Link> links_;
};

// The offset of the tool's mass centre from the axis is all that is missing.
TEST_P(GravityOfArm, IsThatOfTheUrdf) {
  constexpr double kTurn = 1e-4;
  const auto model = read_model(GetParam());
  ASSERT_TRUE(model);
  const Potential potential(*model);
  const auto arm = make_arm(GetParam());
  std::mt19937_64 random(1);
  for (int i = 0; i < 100; ++i) {
    AxisVector joints(arm->axes());
    for (int k = 0; k < arm->axes(); ++k)
      joints[k] =
          std::uniform_real_distribution<>(arm->axis(k).joint.lower, arm->axis(k).joint.upper)(random);
    const Converted motors = arm->transmission().motors(joints);
    if (!motors.inside) continue;  // no such place
    const AxisVector torque = arm->transmission().jacobian(joints).transpose() * arm->gravity(motors.value);
    for (int k = 0; k < arm->axes(); ++k) {
      AxisVector there = joints, back = joints;
      there[k] += kTurn;
      back[k] -= kTurn;
      const double slope = (potential(there) - potential(back)) / (2 * kTurn);
      EXPECT_NEAR(torque[k], slope, 0.06) << arm->axis(k).name << " [N m]";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothArms, GravityOfArm, testing::Values("irb6_postument", "irb6_track"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace mrroc::irb6::test
