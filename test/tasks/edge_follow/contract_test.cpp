#include "tasks/edge_follow/edge_follow.hpp"
#include "test/contract/solo_task.hpp"

namespace mrroc::contract {

struct EdgeFollow : SoloTask<edge_follow::Arm, edge_follow::kEdgeFollow> {
  static constexpr const char* kFolder = "tasks/edge_follow";
  static void configure(const Config& config) { (void)edge_follow::read_rule(config); }
  static bool same(const edge_follow::Memory& a, const edge_follow::Memory& b) {
    return a.T_0E.R == b.T_0E.R && a.T_0E.p == b.T_0E.p && a.angle == b.angle && a.pushing == b.pushing &&
           a.farthest == b.farthest;
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(EdgeFollow, TaskContract, EdgeFollow);

}  // namespace mrroc::contract
