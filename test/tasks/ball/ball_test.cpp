// The coordinator's program in a small world: two palms, springs, a weight.
#include "tasks/ball/ball.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tasks/ball/path.hpp"

namespace mrroc::ball {
namespace {

/// Palms that move as they are ordered, and an object that is a spring between them.
class SpringPort {
 public:
  using X = Coordinator::X;
  using Y = Coordinator::Y;

  double size{0.2};        // of the object [m]
  double weight{5};        // [N]
  double stiffness{5000};  // [N/m]
  int taken_at{-1};        // macrosteps around the circle after which somebody takes it away
  double squeezed{};       // force that somebody adds on both sides around the circle [N]
  std::set<int> begun{};

  SpringPort() {
    for (std::size_t arm = 0; arm < kArms; ++arm)
      place_[arm] = {palm_orientation(arm), Vector3(0.3, 1.05, 0.85) + (arm == 0 ? 0.14 : -0.14) * kLine};
  }
  void dispatch(const Motion<Coordinator>& motion, const Y& y) {
    m_ = motion.m;
    begun.insert(m_);
    around_ += m_ == kCircle;
    for (std::size_t arm = 0; arm < kArms; ++arm) {
      const TaskFrameCommand& f = y.T[arm].arm.frame;
      const double z = f.z.velocity + f.z.mobility * (f.z.force - press());
      place_[arm].p += kPacing.macrostep_s() * (place_[arm].R * Vector3(f.x.velocity, f.y.velocity, z));
    }
  }
  Outcome wait() { return ++macrosteps_ < 20'000 ? Outcome::terminated : Outcome::aborted; }
  void read(X& x) {
    ++x.i;
    x.T.h.started = true;
    x.t.pace = 1;
    x.t.time += 1;
    const bool lifted = m_ >= kLift && m_ <= kLower && place_[0].p.z() > 0.855;
    for (std::size_t arm = 0; arm < kArms; ++arm) {
      Report& r = x.T.agent[arm];
      r.ready = true;
      const AngleAxisPose p = angle_axis_from_pose(place_[arm]);
      std::copy(p.begin(), p.end(), r.T_0E.begin());
      const double added = m_ == kCircle && around_ > 100 ? squeezed : 0;
      r.F_a[Axis::z] = press() + added;
      r.F_a[Axis::x] = lifted && press() > 0 ? weight / 2 : 0;
    }
  }

 private:
  [[nodiscard]] double press() const {
    if (taken_at >= 0 && around_ > taken_at) return 0;
    const double distance = kLine.dot(place_[0].p - place_[1].p);
    return stiffness * std::max(0.0, size - distance);
  }
  std::array<Pose, kArms> place_;
  int m_{}, macrosteps_{}, around_{};
};

Coordinator::X begin(SpringPort& port) {
  Coordinator::X x;
  port.read(x);
  return x;
}

TEST(BallProgram, CarriesTheObjectAroundAndLeavesIt) {
  SpringPort port;
  auto x = begin(port);
  EXPECT_EQ(run_program(x, port), Outcome::terminated);
  EXPECT_EQ(port.begun, (std::set{1, 2, 3, 4, 5, 6, 7})) << "start was given: there is nothing to wait for";
  EXPECT_NEAR(x.c.load, 5, 0.1);
}

/// Expects that the program ends with that failure.
/// @param released  the palms open again @param never  a behaviour that must not have begun
void expect_failure(SpringPort& port, Failure failure, bool released, int never) {
  auto x = begin(port);
  EXPECT_EQ(run_program(x, port), Outcome::faulted);
  EXPECT_EQ(x.c.failure, failure);
  EXPECT_EQ(port.begun.contains(kRelease), released);
  EXPECT_FALSE(port.begun.contains(never));
}

TEST(BallProgram, PutsATooHeavyObjectDownAndReleasesItBeforeItFails) {
  SpringPort port;
  port.weight = 17;  // 2 x 0.8 x 12.5 N / 1.3 = 15.4 N
  expect_failure(port, Failure::too_heavy, true, kCircle);
  EXPECT_TRUE(port.begun.contains(kLower));
}

TEST(BallProgram, DoesNotGoAroundWithAnObjectThatHasStayedOnItsPedestal) {
  SpringPort port;
  port.weight = 0.25 * 0.5 * 9.81 - 0.1;  // a quarter of what is told
  expect_failure(port, Failure::stayed, true, kCircle);
}

TEST(BallProgram, ReleasesAnObjectOfAnotherSizeWithoutLiftingIt) {
  SpringPort port;
  port.size = 0.24;
  expect_failure(port, Failure::not_as_told, true, kLift);
}

TEST(BallProgram, FailsWhereThereIsNothing) {
  SpringPort port;
  port.size = 0.05;
  expect_failure(port, Failure::no_contact, false, kSqueeze);
}

TEST(BallProgram, FailsAtOnceWhenTheObjectIsLostOrCrushed) {
  SpringPort lost, crushed;
  lost.taken_at = 200;
  expect_failure(lost, Failure::lost, false, kLower);
  crushed.squeezed = 20;
  expect_failure(crushed, Failure::crushed, false, kLower);
}

}  // namespace
}  // namespace mrroc::ball
