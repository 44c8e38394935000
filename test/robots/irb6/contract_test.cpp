#include "robots/irb6/arm.hpp"
#include "test/contract/robot_contract.hpp"

namespace mrroc::contract {
namespace {

std::unique_ptr<edp::Robot> postument() { return irb6::make_arm("irb6_postument"); }
std::unique_ptr<edp::Robot> track() { return irb6::make_arm("irb6_track"); }
INSTANTIATE_TEST_SUITE_P(Irb6, RobotContract, testing::Values(postument, track), robot_name);

}  // namespace
}  // namespace mrroc::contract
