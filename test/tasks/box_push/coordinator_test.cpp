// The coordinator against platforms that do what they are told, and a box that goes with them.
#include "tasks/box_push/coordinator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <random>

#include "test/tasks/box_push/halls.hpp"

namespace mrroc::box_push {
namespace {

using X = Coordinator::X;

/// A platform with its driver: takes a fragment two macrosteps after it was ordered, and reports two after that.
class FakePlatform {
 public:
  explicit FakePlatform(const PlanarPose& start) : at_(start) {}

  void order(const Fragment& f) {
    if (f.number <= taken_) return;
    EXPECT_EQ(f.number, taken_ + 1);
    EXPECT_NEAR(distance(f.knot.front().p, end_.p), 0, taken_ == 0 ? 1e-3 : 1e-6) << "fragment " << f.number;
    EXPECT_NEAR(f.knot.front().v, end_.v, 1e-6);
    taken_ = f.number;
    end_ = f.knot.back();
    queue_.push_back(f);
  }
  void advance(double pace) {
    time_ += pace;
    while (!queue_.empty() && time_ >= queue_.front().steps) {
      time_ -= queue_.front().steps;
      at_ = queue_.front().knot.back().p;
      queue_.pop_front();
    }
    if (queue_.empty()) time_ = 0;
    if (!queue_.empty()) at_ = point_at(queue_.front(), time_ / queue_.front().steps).p;
  }
  [[nodiscard]] Report report() const {
    Report r;
    r.ready = true;
    double left = -time_, begun = time_;
    std::int64_t notified = taken_ - static_cast<std::int64_t>(queue_.size());
    for (const Fragment& f : queue_) {
      if (begun >= f.notify) notified = f.number;
      begun -= f.steps;
      left += f.steps;
    }
    const int remaining = queue_.empty() ? 0 : static_cast<int>(std::ceil(left));
    r.event = static_cast<int>(notified);
    r.sensor = kIterationUnit * remaining + (queue_.empty() ? kStands : 0);
    r.T_0E = {at_.x, at_.y, 0, 0, 0, at_.phi};
    return r;
  }
  void begin_at_rest() { end_ = {at_}; }
  [[nodiscard]] const PlanarPose& at() const { return at_; }

 private:
  PlanarPose at_;
  PathPoint end_{at_};
  std::deque<Fragment> queue_;
  double time_{};
  std::int64_t taken_{};
};

/// Everybody whom the coordinator knows.
class World {
 public:
  World(const PlanarPose& box, std::size_t lose) : box_(box), lost_for_(lose) {}

  void dispatch(const Motion<Coordinator>& motion, const Coordinator::Y& y) {
    if (behaviours.empty() || behaviours.back() != motion.m) behaviours.push_back(motion.m);
    orders_.push_back(y.T);
  }
  Outcome wait() {
    ++i_;
    if (orders_.size() > 1) {
      for (std::size_t k = 0; k < kPlatforms; ++k) {
        platform_[k].order(orders_.front()[k].go.fragment);
        platform_[k].advance(orders_.front()[k].variant == kPaused ? 0 : 1);
      }
      orders_.pop_front();
    }
    push();
    reports_.push_back({platform_[0].report(), platform_[1].report()});
    if (i_ % 5 == 0) seen_.push_back({10 * i_, true, noisy(box_)});
    return i_ < kLongest ? Outcome::terminated : Outcome::aborted;
  }
  void read(X& x) {
    x.i = i_;
    x.T.h.started = true;
    for (Report& r : x.T.agent) r.ready = true;
    if (reports_.size() > 1) {
      for (std::size_t k = 0; k < kPlatforms; ++k) x.T.agent[k] = reports_.front()[k];
      reports_.pop_front();
    } else {
      for (std::size_t k = 0; k < kPlatforms; ++k) x.T.agent[k] = platform_[k].report();
    }
    if (i_ > 100 && i_ < 100 + static_cast<std::int64_t>(lost_for_)) x.T.agent[1].sensor |= kPositionLost;
    if (!seen_.empty()) x.V.box = seen_.back();
  }

  [[nodiscard]] const PlanarPose& box() const { return box_; }
  std::vector<int> behaviours;  ///< of the coordinator, in their order
  bool held{};                  ///< nothing moves the box

 private:
  static constexpr std::int64_t kLongest = 60'000;

  /// A box that the noses of both touch goes with the pair.
  void push() {
    const Formation f;
    const PlanarPose &a = platform_[0].at(), &b = platform_[1].at();
    if (std::abs(distance(a, b) - apart(f)) > 0.01 || std::abs(wrap_angle(a.phi - b.phi)) > 0.05)
      return touch_.reset();
    const PlanarPose pair{(a.x + b.x) / 2, (a.y + b.y) / 2, a.phi};
    const PlanarPose seen = seen_from(pair, box_);
    const double before = (f.box_length + f.platform_length) / 2;
    const bool ahead = std::abs(seen.y) < 0.2 && seen.x > 0 && seen.x < before;
    if (ahead && !touch_) touch_ = PlanarPose{before, seen.y + 0.01, seen.phi + 0.01};  // it slips a little
    if (touch_ && seen.x > before + 0.01) touch_.reset();
    if (touch_ && ahead && !held) box_ = chained(pair, *touch_);
  }
  PlanarPose noisy(const PlanarPose& p) {
    return {p.x + 0.005 * noise_(random_), p.y + 0.005 * noise_(random_),
            wrap_angle(p.phi + 0.01 * noise_(random_))};
  }

  PlanarPose box_;
  std::size_t lost_for_;
  std::optional<PlanarPose> touch_;  // the box in the frame of the pair
  std::array<FakePlatform, kPlatforms> platform_{FakePlatform({-2, 0.8, 0}), FakePlatform({-2, -0.8, 0})};
  std::deque<std::array<GoOrder, kAgents>> orders_;
  std::deque<std::array<Report, kPlatforms>> reports_;
  std::vector<MotionCapture> seen_;
  std::mt19937 random_{4};
  std::normal_distribution<double> noise_;
  std::int64_t i_{1};
};

X image(const PlanarPose& goal) {
  X x;
  x.c.k.hall = a_hall();
  x.c.k.goal = goal;
  x.i = 1;
  for (Report& r : x.T.agent) r.ready = true;
  x.T.h.started = true;
  return x;
}

TEST(Coordinator, BringsTheBoxToItsGoal) {
  for (const PlanarPose& goal : {PlanarPose{1.9, 0.8, 0.5}, {-1.2, 0.3, 0.2}, {0.6, -0.5, -0.6}}) {
    World world({0, 0, 0}, 0);
    X x = image(goal);
    world.read(x);
    ASSERT_EQ(push_box(x, world), Outcome::terminated);
    EXPECT_TRUE(at_goal(x.c)) << goal.x;
    EXPECT_NEAR(distance(world.box(), goal), 0, 0.025) << goal.x;
    EXPECT_NEAR(wrap_angle(world.box().phi - goal.phi), 0, 0.05) << goal.x;
    EXPECT_EQ(world.behaviours.back(), kLook.m) << "it has looked at the box from away";
  }
}

TEST(Coordinator, DoesNothingAboutABoxThatIsAtItsGoal) {
  World world({0.5, 0.2, 0.3}, 0);
  X x = image({0.5, 0.2, 0.3});
  world.read(x);
  ASSERT_EQ(push_box(x, world), Outcome::terminated);
  EXPECT_TRUE(at_goal(x.c));
  EXPECT_EQ(x.c.pushes, 0);
}

TEST(Coordinator, GivesUpWhereThereIsNoWay) {
  World world({0, 0, 0}, 0);
  X x = image({4.9, 0, 0});
  world.read(x);
  ASSERT_EQ(push_box(x, world), Outcome::terminated);
  EXPECT_EQ(x.c.dead_end, DeadEnd::for_box);
  EXPECT_FALSE(at_goal(x.c));
}

TEST(Coordinator, StopsAfterThePushesThatItMay) {
  World world({0, 0, 0}, 0);
  X x = image({0.6, -0.5, -0.6});
  x.c.k.pushes = 1;
  world.read(x);
  ASSERT_EQ(push_box(x, world), Outcome::terminated);
  EXPECT_EQ(x.c.pushes, 1);
  EXPECT_FALSE(at_goal(x.c));
}

TEST(Coordinator, GivesUpWhenTheBoxDoesNotGoWithThePlatforms) {
  World world({0, 0, 0}, 0);
  world.held = true;
  X x = image({1.5, 0, 0});
  world.read(x);
  ASSERT_EQ(push_box(x, world), Outcome::terminated);
  EXPECT_TRUE(stays_behind(x.c.run));
  EXPECT_GT(x.c.run.lag, kMostLag);
  EXPECT_LT(x.c.run.lag, kMostLag + 0.1) << "before it is far";
  EXPECT_EQ(x.c.pushes, 1);
  EXPECT_EQ(world.behaviours.back(), kPush.m);
}

TEST(Coordinator, GivesUpWhenAPlatformStandsWhereItCannotTurn) {
  World world({0, 0, 0}, 0);
  X x = image({1.5, 0, 0});
  x.c.k.hall.room.obstacles.push_back(rectangle({-2.5, 0.8, 0}, 0.1, 0.1));
  world.read(x);
  ASSERT_EQ(push_box(x, world), Outcome::terminated);
  EXPECT_EQ(x.c.dead_end, DeadEnd::for_platform);
  EXPECT_EQ(x.c.pushes, 0);
}

TEST(Coordinator, TellsHowManyPushesAndHowLongBeforeTheFirstOne) {
  World world({0, 0, 0}, 0);
  X x = image({1.9, 0.8, 0.44});
  world.read(x);
  ASSERT_EQ(push_box(x, world), Outcome::terminated);
  EXPECT_EQ(x.c.outlook.pushes, x.c.pushes) << "an easy way goes as it was planned";
  const double took = static_cast<double>(x.i) * kPlatformPeriod;
  EXPECT_NEAR(x.c.outlook.seconds, took, 0.3 * took);
}

TEST(Coordinator, EverybodyStandsWhileAPlatformDoesNotKnowItsPosition) {
  X x = image({1, 0, 0});
  x.T.agent[1].sensor = kPositionLost;
  for (const GoOrder& order : kPush.f_cT(x)) EXPECT_EQ(order.variant, kPaused);
  x.T.agent[1].sensor = 0;
  EXPECT_EQ(kPush.f_cT(x)[0].variant, 0);
  x.t.paused = true;
  EXPECT_EQ(kPush.f_cT(x)[0].variant, kPaused) << "and in a pause";
}

TEST(Coordinator, GoesOnWhenThePositionIsBackAndGivesUpWhenItIsNot) {
  for (const bool back : {true, false}) {
    World world({0, 0, 0}, back ? 100 : 100'000);
    X x = image({1.5, 0, 0});
    x.c.k.timeout = 500;
    world.read(x);
    ASSERT_EQ(push_box(x, world), Outcome::terminated);
    EXPECT_EQ(position_gone(x), !back);
    EXPECT_EQ(at_goal(x.c), back);
  }
}

}  // namespace
}  // namespace mrroc::box_push
