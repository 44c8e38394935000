#include "test/contract/sensor_contract.hpp"
#include "vsp/pen_state/pen_state_sensor.hpp"

namespace mrroc::contract {
namespace {

struct PenStateCase {
  static vsp::PenStateSensor make() { return vsp::PenStateSensor(); }
  static constexpr int kStates = 4;
};
INSTANTIATE_TYPED_TEST_SUITE_P(PenState, SensorContract, PenStateCase);

}  // namespace
}  // namespace mrroc::contract
