// What is recorded of the true cube, macrostep by macrostep.
#include "tasks/rubik/cube_record.hpp"

#include <gtest/gtest.h>

#include "test/base/link/buses.hpp"

namespace mrroc::rubik {
namespace {

class CubeRecordTest : public ::testing::Test {
 protected:
  static link::NodeContext context() {
    return {.session = "s", .session_id = 1, .name = "mp", .roster = {"mp", "world"}};
  }
  void tell(std::int64_t i, double angle = 0, double other = 0) {
    cube_truth_t m{};
    for (int k = 0; k < 12; ++k) m.T_UC[k] = k + 1;
    for (int k = 0; k < 3; ++k) {
      m.in_hand[0][k] = 20 + k;
      m.in_hand[1][k] = 30 + k;
    }
    std::fill(std::begin(m.facelets), std::end(m.facelets), 'U');
    m.facelets[53] = 'B';
    m.angle[0] = angle;
    m.angle[1] = other;
    m.squeeze = 4.5;
    m.on_floor = static_cast<std::int32_t>(i % 2);
    truth_.publish(m, i);
  }

  link::test::DirectBus bus_;
  link::Process process_{bus_, context()};
  CubeRecord record_{process_};
  link::Outbox<cube_truth_t> truth_{bus_, process_.route("cube.truth"), 1};
};

TEST_F(CubeRecordTest, HasEverythingThatTheSimulatorTells) {
  tell(3, 0.1, -0.2);
  record_.collect();
  ASSERT_EQ(record_.rows().size(), 1U);
  const CubeRow& row = record_.rows()[0];
  EXPECT_EQ(row.i, 3);
  Matrix3 R;
  R << 1, 2, 3, 5, 6, 7, 9, 10, 11;
  EXPECT_EQ(row.T_UC.R, R);
  EXPECT_EQ(row.T_UC.p, Vector3(4, 8, 12));
  EXPECT_EQ(row.in_hand[0], Vector3(20, 21, 22));
  EXPECT_EQ(row.in_hand[1], Vector3(30, 31, 32));
  EXPECT_EQ(row.facelets, std::string(53, 'U') + "B");
  EXPECT_EQ(row.angle, -0.2) << "of the layer that is farthest from its seat";
  EXPECT_EQ(row.squeeze, 4.5);
  EXPECT_TRUE(row.on_floor);
  tell(4, -0.3, 0.2);
  record_.collect();
  EXPECT_EQ(record_.rows()[1].angle, -0.3);
  EXPECT_FALSE(record_.rows()[1].on_floor);
}

TEST_F(CubeRecordTest, HasARowForEveryMacrostepOnceInOrder) {
  tell(1);
  tell(2);
  record_.collect();
  record_.collect();
  tell(4);
  tell(5);
  record_.collect();
  std::vector<std::int64_t> all;
  for (const CubeRow& row : record_.rows()) all.push_back(row.i);
  EXPECT_EQ(all, (std::vector<std::int64_t>{1, 2, 4, 5}));
}

TEST_F(CubeRecordTest, OfAMacrostepWithoutARowTheOneBeforeIsGiven) {
  EXPECT_EQ(record_.at(5), nullptr);
  tell(2);
  tell(4);
  record_.collect();
  EXPECT_EQ(record_.at(1), nullptr);
  EXPECT_EQ(record_.at(2)->i, 2);
  EXPECT_EQ(record_.at(3)->i, 2);
  EXPECT_EQ(record_.at(4)->i, 4);
  EXPECT_EQ(record_.at(99)->i, 4);
}

}  // namespace
}  // namespace mrroc::rubik
