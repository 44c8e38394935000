// The operator of a task without hands: he gives start where nobody else does, and tells the simulator
// of pauses.
#include "mp/auto_start_operator.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "test/base/link/buses.hpp"

namespace mrroc::mp {
namespace {

struct Room {
  explicit Room(bool gives_start) : human(process, command_server, gives_start) {}
  static link::NodeContext context_of() {
    link::NodeContext m;
    m.session = "s";
    m.name = "mp";
    m.roster = {"mp"};
    return m;
  }
  link::test::DirectBus bus;
  link::Process process{bus, context_of()};
  OperatorCommandServer command_server{process, {}, {}};
  AutoStartOperator human;
  link::Queue<operator_image_t> images{bus, process.route("operator.image"), 1};
};

TEST(AutoStartOperator, GivesStartWhenTheTaskWaitsForItAndNobodyElseDoes) {
  for (const bool gives : {true, false}) {
    Room room(gives);
    room.command_server.set_state(TaskState::running, false);
    EXPECT_FALSE(room.human.image(1).started) << "nobody waits for it";
    room.command_server.set_state(TaskState::waiting_for_start, false);
    EXPECT_EQ(room.human.image(2).started, gives);
    const auto first = room.images.take(), second = room.images.take();
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->header.stamp, 1);
    EXPECT_EQ(second->header.stamp, 2);
    EXPECT_EQ(second->started, gives ? 1 : 0);
    EXPECT_EQ(second->paused, 0);
  }
}

TEST(AutoStartOperator, TheLogHasTheImageThatTheTaskSees) {
  Room room(true);
  room.command_server.set_state(TaskState::waiting_for_start, false);
  std::ignore = room.human.image(1);
  room.command_server.set_state(TaskState::running, true);
  ASSERT_TRUE(room.command_server.give(OperatorOrder::trigger));
  ASSERT_TRUE(room.command_server.give(OperatorOrder::pause));
  const OperatorImage image = room.human.image(2);
  std::ignore = room.images.take();
  const auto seen = room.images.take();
  ASSERT_TRUE(seen);
  EXPECT_EQ(image.trigger, 1);
  EXPECT_EQ(seen->trigger, 1);
  EXPECT_EQ(seen->started, 1);
  EXPECT_EQ(seen->paused, 1);
  EXPECT_TRUE(room.human.here(3)) << "nothing has to come";
  EXPECT_EQ(room.human.inbox(), nullptr);
}

}  // namespace
}  // namespace mrroc::mp
