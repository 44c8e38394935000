// What every robot promises (test/contract/robot_contract.hpp), asked of the conveyor.
#include "robots/conveyor/conveyor.hpp"
#include "test/contract/robot_contract.hpp"

namespace mrroc::contract {
namespace {

std::unique_ptr<edp::Robot> make() { return conveyor::type().make(0); }
INSTANTIATE_TEST_SUITE_P(Conveyor, RobotContract, testing::Values(make), robot_name);

}  // namespace
}  // namespace mrroc::contract
