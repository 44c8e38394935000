// Messages between coordinator and arms: they survive the link, and nothing improper is taken from the
// network.
#include "tasks/rubik/turn/order.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "base/link/transmission_link.hpp"

namespace mrroc::rubik {
namespace {

static_assert(link::Transmitted<CubeOrder> && link::Transmitted<CubeReport>);

CubeOrder random_order(std::mt19937& random) {
  const auto number = [&](double least, double most) {
    return std::uniform_real_distribution<>(least, most)(random);
  };
  CubeOrder o;
  o.turn = {.torque = number(-5, 5), .mobility = number(0, 0.2), .angle = number(-1, 3.2)};
  o.jaw_step = number(0, 0.01);
  for (double& q : o.point.motors) q = number(-200, 200);
  o.point.speed = number(0, 1);
  o.jaws = number(0, 0.09);
  o.weight = number(0, 50);
  for (double& p : o.mass_centre) p = number(-0.3, 0.3);
  return o;
}

TEST(CubeOrders, SurviveTheirWay) {
  std::mt19937 random(1);
  for (int k = 0; k < 1000; ++k) {
    const CubeOrder o = random_order(random);
    const cube_order_t m = to_message(o);
    ASSERT_TRUE(is_proper(m));
    const CubeOrder got = from_message(m);
    EXPECT_EQ(got.turn.torque, o.turn.torque);
    EXPECT_EQ(got.turn.mobility, o.turn.mobility);
    EXPECT_EQ(got.turn.angle, o.turn.angle);
    EXPECT_EQ(got.jaw_step, o.jaw_step);
    EXPECT_EQ(got.point, o.point);
    EXPECT_EQ(got.jaws, o.jaws);
    EXPECT_EQ(got.weight, o.weight);
    EXPECT_EQ(got.mass_centre, o.mass_centre);
  }
  EXPECT_TRUE(is_proper(to_message(CubeOrder{}))) << "nothing is ordered";
}

TEST(CubeOrders, AreNotTakenWithANumberThatIsNoneOrBeyondAllBounds) {
  const std::vector<std::function<double&(cube_order_t&)>> fields{
      [](auto& m) -> double& { return m.torque; },
      [](auto& m) -> double& { return m.mobility; },
      [](auto& m) -> double& { return m.angle; },
      [](auto& m) -> double& { return m.jaw_step; },
      [](auto& m) -> double& { return m.motors[0]; },
      [](auto& m) -> double& { return m.motors[7]; },
      [](auto& m) -> double& { return m.speed; },
      [](auto& m) -> double& { return m.jaws; },
      [](auto& m) -> double& { return m.weight; },
      [](auto& m) -> double& { return m.mass_centre[0]; },
      [](auto& m) -> double& { return m.mass_centre[2]; },
  };
  constexpr double kInf = std::numeric_limits<double>::infinity();
  std::mt19937 random(2);
  for (const auto& field : fields)
    for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), kInf, -kInf, 1e9, -1e9}) {
      cube_order_t m = to_message(random_order(random));
      field(m) = wrong;
      EXPECT_FALSE(is_proper(m)) << &field - fields.data() << ": " << wrong;
    }
}

TEST(CubeReports, SurviveTheirWayAndNameNoMorePointsThanAPathHas) {
  for (int points = -3; points <= kMostPoints + 3; ++points) {
    const cube_report_t m = to_message(CubeReport{.points = points});
    EXPECT_EQ(from_message(m).points, points);
    EXPECT_EQ(is_proper(m), points >= 0 && points <= kMostPoints) << points;
  }
}

TEST(CubeOrders, AreTakenUpToTheirBoundsAndNotBeyond) {
  struct Field {
    std::function<double&(cube_order_t&)> of;
    double least, most;
  };
  for (const Field& field :
       std::vector<Field>{{[](auto& m) -> double& { return m.torque; }, -100, 100},
                          {[](auto& m) -> double& { return m.mobility; }, 0, 100},
                          {[](auto& m) -> double& { return m.angle; }, -100, 100},
                          {[](auto& m) -> double& { return m.jaw_step; }, 0, 1},
                          {[](auto& m) -> double& { return m.motors[3]; }, -1e5, 1e5},
                          {[](auto& m) -> double& { return m.speed; }, 0, 1},
                          {[](auto& m) -> double& { return m.jaws; }, 0, 1},
                          {[](auto& m) -> double& { return m.weight; }, 0, 1000},
                          {[](auto& m) -> double& { return m.mass_centre[1]; }, -10, 10}})
    for (const double bound : {field.least, field.most}) {
      cube_order_t m = to_message(CubeOrder{});
      field.of(m) = bound;
      EXPECT_TRUE(is_proper(m)) << bound;
      field.of(m) = std::nextafter(bound, bound == field.least ? -1e9 : 1e9);
      EXPECT_FALSE(is_proper(m)) << bound;
    }
}

}  // namespace
}  // namespace mrroc::rubik
