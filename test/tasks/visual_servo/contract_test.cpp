#include <vector>

#include "tasks/visual_servo/config.hpp"
#include "tasks/visual_servo/program.hpp"
#include "test/contract/task_contract.hpp"

namespace mrroc::visual_servo {

/// What a picture may tell: anything, older or newer than the task believes.
void vary(CameraImage& image, std::mt19937& random) {
  using contract::happens;
  CameraReading& r = image.reading;
  image.there = true;
  r.frame += happens(0.9, random) ? 1 : 0;
  r.step = -static_cast<std::int64_t>(random() % 70);
  if (happens(0.05, random)) r.seen = !r.seen;
  for (double& x : r.T_CG.p) contract::wander(x, 0.3, random);
  for (double& x : image.T_0E.p) contract::wander(x, 0.3, random);
  r.covariance = 1e-6 * Matrix6::Identity();
}
}  // namespace mrroc::visual_servo

namespace mrroc::contract {
namespace {

bool same_pose(const Pose& a, const Pose& b) { return a.R == b.R && a.p == b.p; }

struct VisualServo {
  using Agent = visual_servo::Arm;
  static constexpr const char* kFolder = "tasks/visual_servo";
  static constexpr int kForever = 5;
  static constexpr bool kHasNoDefaults = true;  // nobody can guess where the cameras stand

  static auto behaviours() {
    std::vector<Motion<Agent>> all;
    for (const visual_servo::Selectable& row : visual_servo::kBehaviours) all.push_back(row.motion);
    all.push_back(visual_servo::kGiveUp);
    return all;
  }
  static Outcome run(Agent::X& x, auto& port) {
    port.read(x);
    visual_servo::Parameters k;
    k.duration = 400;
    k.timeout = 15;
    x.c = visual_servo::begin(k, x.i);
    return visual_servo::run_program(x, port);
  }
  static auto seen(Agent::X& x) { return std::tie(x.e, x.V.camera, x.T); }
  static bool same(const visual_servo::Memory& a, const visual_servo::Memory& b) {
    return a.taken == b.taken && same_pose(a.e, b.e) && same_pose(a.under_way, b.under_way) &&
           same_pose(a.before, b.before) && a.made_in == b.made_in && a.ease == b.ease &&
           a.refused == b.refused && a.begun == b.begun && a.seen_in == b.seen_in &&
           a.track.step == b.track.step && same_pose(a.track.T_0G, b.track.T_0G) && a.track.v == b.track.v &&
           a.track.omega == b.track.omega && a.track.P == b.track.P;
  }
  static void configure(const Config& config) { (void)visual_servo::read_parameters(config); }
};
INSTANTIATE_TYPED_TEST_SUITE_P(VisualServo, TaskContract, VisualServo);

}  // namespace
}  // namespace mrroc::contract
