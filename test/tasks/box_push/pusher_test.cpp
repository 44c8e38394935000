// The agent of a platform: hands over what the coordinator sends, and tells how far it is.
#include "tasks/box_push/pusher.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/script_port.hpp"

namespace mrroc::box_push {
namespace {

using X = Pusher::X;

X image(std::int64_t fragment) {
  X x;
  x.T.m = 3;
  x.T.go.fragment.number = fragment;
  x.T.go.fragment.steps = 30;
  x.e.position_known = true;
  return x;
}

TEST(Pusher, HandsEveryFragmentOverOnce) {
  std::vector<X> images{image(0), image(0), image(1), image(1), image(1), image(2), image(2)};
  images.back().T.finished = true;
  ScriptPort<Pusher> port(images);
  X x;
  x.T.m = 1;
  std::ignore = run_pusher(x, port);
  std::vector<std::int64_t> handed;
  for (const auto& d : port.decisions())
    if (d.y.e.instruction == Instruction::set) handed.push_back(d.y.e.fragment.number);
  EXPECT_EQ(handed, (std::vector<std::int64_t>{1, 2}));
}

TEST(Pusher, PassesTheMapOnAndStandsInAPause) {
  X x = image(1);
  x.T.map.pose.valid = true;
  x.T.map.pose.step = 70;
  EXPECT_EQ(kFollow.f_ce(x).map.step, 70);
  EXPECT_EQ(kFollow.f_ce(x).pace, 1);
  x.T.variant = kPaused;
  EXPECT_EQ(kFollow.f_ce(x).pace, 0);
  EXPECT_EQ(kReady.f_ce(x).instruction, Instruction::keep);
}

TEST(Pusher, TellsHowFarItIs) {
  X x = image(4);
  x.c.handed = 4;
  x.e.notified = 3;
  x.e.remaining = 17;
  PusherSaid said = kFollow.f_cT(x);
  EXPECT_EQ(said.event, 3);
  EXPECT_EQ(said.sensor, 17 * kIterationUnit);
  x.e.notified = 4;
  x.e.remaining = 0;
  x.e.at_rest = true;
  said = kFollow.f_cT(x);
  EXPECT_EQ(said.sensor, kStands);
}

TEST(Pusher, TellsThatItsPositionIsLostUntilItIsClearlyBetter) {
  X x = image(0);
  x.c.k.lost = 0.2;
  x.e.estimate.covariance[0] = 0.21 * 0.21;
  EXPECT_EQ(kFollow.f_cT(x).sensor & kPositionLost, kPositionLost);
  x.e.estimate.covariance[0] = 0.18 * 0.18;
  EXPECT_EQ(kFollow.f_cT(x).sensor & kPositionLost, 0);
  x.c.lost = true;
  EXPECT_EQ(kFollow.f_cT(x).sensor & kPositionLost, kPositionLost);
}

TEST(Pusher, TellsAFaultThatIsNoAnswer) {
  X x = image(0);
  x.e.fault.code = FaultCode::wheel_blocked;
  EXPECT_EQ(kFollow.f_cT(x).verdict, Verdict::failed);
}

}  // namespace
}  // namespace mrroc::box_push
