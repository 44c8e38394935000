#include "tasks/press/press.hpp"
#include "test/contract/solo_task.hpp"

namespace mrroc::contract {

struct Press : SoloTask<press::Arm, press::kPress> {
  static constexpr const char* kFolder = "tasks/press";
};
INSTANTIATE_TYPED_TEST_SUITE_P(Press, TaskContract, Press);

}  // namespace mrroc::contract
