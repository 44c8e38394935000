#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

#include "tasks/ball/ball.hpp"
#include "tasks/ball/config.hpp"
#include "tasks/ball/path.hpp"
#include "test/contract/task_contract.hpp"

namespace mrroc::contract {
namespace {

/// Nothing is held by chance: what the arms report is put near to what two palms with an object between them would feel.
void hold_an_object(ball::Coordinator::X& x) {
  const ball::Parameters& k = x.c.k;
  for (std::size_t arm = 0; arm < ball::kArms; ++arm) {
    Report& r = x.T.agent[arm];
    const Vector3 wandering(r.T_0E[0], r.T_0E[1], r.T_0E[2]);
    const double side = (arm == 0 ? 0.5 : -0.5) * k.body.size;
    const AngleAxisPose T_0E =
        angle_axis_from_pose({ball::palm_orientation(arm), side * ball::kLine + 0.001 * wandering});
    std::ranges::copy(T_0E, r.T_0E.begin());
    r.F_a[Axis::z] = k.force + 0.05 * r.F_a[Axis::z];
    r.F_a[Axis::x] = k.body.mass * 9.81 / 2 + 0.05 * r.F_a[Axis::x];  // up
    r.F_a[Axis::y] *= 0.05;
  }
}

struct Ball {
  static constexpr const char* kFolder = "tasks/ball";
  static constexpr bool kHasNoDefaults = true;  // of what is carried
  using Agent = ball::Coordinator;
  static void configure(const Config& config) {
    std::ignore = ball::read_parameters(config);
    std::ignore = ball::read_hand_push(config);
  }
  static auto behaviours() {
    std::vector<Motion<Agent>> all(ball::kBehaviours.begin(), ball::kBehaviours.end());
    all.push_back(ball::kWaitForStart);
    return all;
  }
  static Outcome run(Agent::X& x, auto& port) {
    struct Holding {
      decltype(port)& inner;
      void dispatch(const Motion<Agent>& motion, const Agent::Y& y) { inner.dispatch(motion, y); }
      Outcome wait() { return inner.wait(); }
      void read(Agent::X& image) {
        const auto agents = kept;
        if (agents) image.T.agent = *agents;
        inner.read(image);
        kept = image.T.agent;
        hold_an_object(image);
      }
      std::optional<decltype(Agent::X::T.agent)> kept{};  // as they wander
    } holding{port};
    return ball::run_program(x, holding);
  }
  static auto seen(Agent::X& x) { return std::tie(x.T.agent, x.T.h); }
  static bool same(const ball::Memory& a, const ball::Memory& b) {
    const auto of = [](const ball::Memory& c) {
      return std::tie(c.age, c.grip, c.shift, c.yielded, c.closed, c.load, c.touching, c.steady, c.lost,
                      c.failure);
    };
    return of(a) == of(b);
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Ball, TaskContract, Ball);

}  // namespace
}  // namespace mrroc::contract
