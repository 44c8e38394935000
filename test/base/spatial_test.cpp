#include "base/spatial.hpp"
#include "base/axis_command.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

namespace mrroc {
namespace {

template <class A, class B>
concept Addable = requires(A a, B b) {
  a + b;
};
static_assert(Addable<Twist, Twist> && Addable<Wrench, Wrench>);
static_assert(!Addable<Twist, Wrench>, "a velocity plus a force must not compile");
static_assert(!std::is_convertible_v<Twist, Wrench> && !std::is_assignable_v<Wrench&, Twist>);
static_assert(std::is_trivially_copyable_v<Twist> && sizeof(Twist) == 6 * sizeof(double));

TEST(Spatial, AxesAreInTheOrderOfThePapersVectors) {
  Twist v;
  double value = 1;
  for (const Axis a : kAxes) v[a] = value++;
  EXPECT_EQ(v.v, (std::array<double, 6>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(v.linear(), Vector3(1, 2, 3));
  EXPECT_EQ(v.angular(), Vector3(4, 5, 6));
  EXPECT_EQ(Twist::from(v.linear(), v.angular()), v);
}

TEST(Spatial, SumsAndMultiplesAreByComponent) {
  constexpr Wrench a{{1, 2, 3, 4, 5, 6}};
  constexpr Wrench b{{6, 5, 4, 3, 2, 1}};
  static_assert(a + b == Wrench{{7, 7, 7, 7, 7, 7}});
  static_assert(a - b == Wrench{{-5, -3, -1, 1, 3, 5}});
  static_assert(-a == a * -1 && 2 * a == a + a);
  EXPECT_EQ((a - b).vector(), a.vector() - b.vector());
}

TEST(AxisCommand, HasWhatThePapersTablesHaveAndNothingElse) {
  EXPECT_EQ(u(0.3), (AxisCommand{Behaviour::unguarded, 0, 0.3, 0, 0}));
  EXPECT_EQ(u(), AxisCommand{});
  EXPECT_EQ(g(0.3, 5, 0.01), (AxisCommand{Behaviour::guarded, 0, 0.3, 5, 0.01}));
  EXPECT_EQ(c(4, 20, 0.005), (AxisCommand{Behaviour::contact, 4, 0, 20, 0.005}));
  EXPECT_FALSE(u(1) == u(2));
}

TEST(TaskFrameCommand, RowsAreFoundByTheirAxes) {
  TaskFrameCommand frame;
  for (const Axis a : kAxes) frame[a] = u(1 + static_cast<double>(a));
  EXPECT_EQ(frame, (TaskFrameCommand{u(1), u(2), u(3), u(4), u(5), u(6)}));
  EXPECT_EQ(frame.ax.velocity, 4);
  const TaskFrameCommand& same = frame;
  for (const Axis a : kAxes) EXPECT_EQ(same[a].velocity, 1 + static_cast<double>(a));
}

TEST(Spatial, OneComponentThatIsNotFiniteIsEnough) {
  EXPECT_TRUE(finite(Twist{}));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()})
    for (const Axis a : kAxes) {
      Twist v;
      v[a] = bad;
      EXPECT_FALSE(finite(v));
    }
}

}  // namespace
}  // namespace mrroc
