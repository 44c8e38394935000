// The room as everybody reads it.
#include "base/room_config.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "base/fault.hpp"

namespace mrroc {
namespace {

Room room(const std::string& text) { return read_room(Config::parse(text, "test.toml")); }

const Obstacle& named(const Room& r, const std::string& name) {
  return *std::ranges::find(r.obstacles, name, &Obstacle::name);
}

TEST(RoomConfig, BuiltInRoomIsFreeWhereItIsPromisedAndEndsBeyond) {
  const Room r = room("");
  EXPECT_EQ(r.obstacles.size(), built_in_room().obstacles.size());
  constexpr double kReach = 0.55;
  for (double x = -2.2; x <= 2.2; x += 0.1)
    for (double y = -1.4; y <= 1.4; y += 0.1)
      EXPECT_GE(clearance(r, {x, y}, {x, y}), kReach) << x << ' ' << y;
  for (const RoomPoint beyond : {RoomPoint{3.01, 0}, {-3.01, 0}, {0, 2.01}, {0, -2.01}})
    EXPECT_LT(clearance(r, beyond, beyond), 0);
}

TEST(RoomConfig, ObstaclesAreBoxesOrPolygonsOfEitherDirection) {
  const Room r = room(
      "[room]\nfurniture = false\nwalls = [-5, -4, 5, 4]\n"
      "[room.obstacles.crate]\nbox = [1, 0, 2, 0.4, 1.5707963267948966]\n"
      "[room.obstacles.left]\npolygon = [1, 1, 2, 1, 1, 2]\n"
      "[room.obstacles.right]\npolygon = [1, 2, 2, 1, 1, 1]\n");
  ASSERT_EQ(r.obstacles.size(), 3U);
  EXPECT_EQ(r.lower, (RoomPoint{-5, -4}));
  EXPECT_EQ(r.upper, (RoomPoint{5, 4}));
  const Obstacle& crate = named(r, "crate");
  for (const RoomPoint& corner : crate.corner) {
    EXPECT_NEAR(std::abs(corner[0] - 1), 0.2, 1e-9);
    EXPECT_NEAR(std::abs(corner[1]), 1, 1e-9);
  }
  for (const std::string name : {"left", "right"}) EXPECT_EQ(clearance(r, {1.2, 1.2}, {1.2, 1.2}), 0) << name;
}

TEST(RoomConfig, WhatARunHasWrittenIsTheSameRoom) {
  const std::string given = "[room.obstacles.crate]\nbox = [1, 0, 2, 0.4, 0.3]\n";
  const Config config = Config::parse(given, "test.toml");
  const Room first = read_room(config), again = room(config.dump());
  ASSERT_EQ(again.obstacles.size(), first.obstacles.size());
  for (std::size_t k = 0; k < first.obstacles.size(); ++k) {
    EXPECT_EQ(again.obstacles[k].name, first.obstacles[k].name);
    EXPECT_EQ(again.obstacles[k].corner, first.obstacles[k].corner);
  }
  EXPECT_NO_THROW(config.check_all_used());
}

TEST(RoomConfig, RefusesWhatIsNoRoom) {
  for (const std::string wrong :
       {"[room]\nwalls = [1, 1, 0, 0]", "[room]\nwalls = [0, 0, 1]", "[room]\nwalls = [0, 0, 1e9, 1]",
        "[room.obstacles.a]\npolygon = [0, 0, 1, 0]", "[room.obstacles.a]\npolygon = [0, 0, 1, 0, 1]",
        "[room.obstacles.a]\npolygon = [0, 0, 1, 0, 2, 0]",
        "[room.obstacles.a]\npolygon = [0, 0, 2, 0, 1, 0.5, 2, 2]",
        "[room.obstacles.a]\npolygon = [0, 1, 0.6, -0.8, -0.95, 0.3, 0.95, 0.3, -0.6, -0.8]",
        "[room.obstacles.a]\nbox = [0, 0, 0, 1, 0]", "[room.obstacles.a]\nbox = [0, 0, 1, 1]",
        "[room.obstacles.a]\nbox = [0, 0, 1, 1, 0]\npolygon = [0, 0, 1, 0, 0, 1]", "[room.obstacles.a]"}) {
    try {
      room(wrong);
      ADD_FAILURE() << wrong << " was taken";
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
      EXPECT_NE(std::string(e.what()).find("room."), std::string::npos) << e.what();
    }
  }
}

/// Against many points of the way.
TEST(Clearance, IsTheLeastDistanceOfAllPlacesOfTheWay) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> x(-3, 3), y(-2, 2);
  Room r = built_in_room();
  r.obstacles.push_back({"crate", {{0, 0}, {0.7, 0.2}, {0.5, 0.9}}});
  int touched = 0;
  for (int k = 0; k < 300; ++k) {
    const RoomPoint from{x(random), y(random)}, to{x(random), y(random)};
    constexpr int kPlaces = 2000;
    double least = std::numeric_limits<double>::infinity();
    for (int n = 0; n <= kPlaces; ++n) {
      const double s = static_cast<double>(n) / kPlaces;
      const RoomPoint place{std::lerp(from[0], to[0], s), std::lerp(from[1], to[1], s)};
      least = std::min(least, clearance(r, place, place));
    }
    touched += least == 0 ? 1 : 0;
    EXPECT_NEAR(clearance(r, from, to), least, 0.003) << k;
    EXPECT_NEAR(clearance(r, from, to), clearance(r, to, from), 1e-12);
  }
  EXPECT_GT(touched, 20);
}

}  // namespace
}  // namespace mrroc
