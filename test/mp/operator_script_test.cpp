// Orders from a script, and the script that a run leaves.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <tuple>

#include "base/fault.hpp"
#include "test/mp/command_server_fixture.hpp"

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;
using enum OperatorOrder;

/// Plays a task whose state follows the operator's image.
std::vector<std::tuple<std::int64_t, bool, bool, bool>> play(
    CommandServerFixture& fixture, int macrosteps, const std::function<void(std::int64_t)>& meanwhile) {
  std::vector<std::tuple<std::int64_t, bool, bool, bool>> images;
  OperatorImage image;
  for (std::int64_t i = 1; i <= macrosteps; ++i) {
    meanwhile(i);
    image = fixture.command_server.take(i);
    images.emplace_back(image.trigger, image.started, image.paused, fixture.command_server.stop_ordered());
    fixture.command_server.set_state(!image.started ? TaskState::waiting_for_start
                                     : image.paused ? TaskState::paused
                                                    : TaskState::running,
                                     (i / 20) % 2 == 0);
  }
  return images;
}

TEST_F(CommandServer, TheRecordOfARunReplaysIt) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::mt19937 random(seed);
    CommandServerFixture first({}, folder_ / "record");
    const auto images = play(first, 400, [&](std::int64_t) {
      if (random() % 3 == 0) first.accepts(static_cast<OperatorOrder>(random() % 4));
      if (random() % 9 == 0) first.command_server.give(static_cast<OperatorOrder>(random() % 4));
    });
    EXPECT_GE(std::get<0>(images.back()), 3);
    CommandServerFixture second(load_script(folder_ / "record"), folder_ / "second");
    EXPECT_EQ(play(second, 400, [](std::int64_t) {}), images);
    std::ifstream a(folder_ / "record"), b(folder_ / "second");
    const std::string text_a{std::istreambuf_iterator<char>(a), {}},
        text_b{std::istreambuf_iterator<char>(b), {}};
    EXPECT_EQ(text_a, text_b);
  }
}

TEST_F(CommandServer, AScriptedOrderThatIsNotAllowedIsRefusedAloud) {
  CommandServerFixture fixture({{2, start}, {3, start}});
  fixture.command_server.set_state(TaskState::waiting_for_start, false);
  fixture.command_server.take(1);
  EXPECT_FALSE(fixture.lines.take());
  fixture.command_server.take(2);
  EXPECT_TRUE(fixture.lines.take());
  fixture.command_server.take(3);
  const auto line = fixture.lines.take();
  ASSERT_TRUE(line);
  EXPECT_EQ(line->code, static_cast<int>(FaultCode::bad_script));
  EXPECT_EQ(link::get_text(line->text),
            "script: start in macrostep 3 is refused, the task has been started already");
}

TEST_F(CommandServer, ScriptIsReadWithCommentsAndInTheOrderOfMacrosteps) {
  const auto script =
      load_script(write("# a comment\n\n 30 trigger # the second\n10 start\r\n30 pause\n20   trigger\n"));
  ASSERT_EQ(script.size(), 4U);
  EXPECT_EQ(script[0].i, 10);
  EXPECT_EQ(script[0].order, start);
  EXPECT_EQ(script[1].i, 20);
  EXPECT_EQ(script[2].order, trigger);
  EXPECT_EQ(script[3].order, pause);
}

TEST_F(CommandServer, AScriptThatCannotBeUsedIsRefusedWithItsLine) {
  for (const char* line : {"start", "10", "10 begin", "10 Start", "0 start", "-5 start", "10 start now",
                           "1.5 start", "99999999999999999999 start", "0x10 start", "10start"}) {
    try {
      load_script(write(std::string("5 start\n") + line + "\n"));
      ADD_FAILURE() << line;
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_script) << line;
      EXPECT_NE(std::string(e.what()).find("script:2:"), std::string::npos) << e.what();
    }
  }
  EXPECT_THROW(load_script(folder_ / "missing"), FaultError);
  EXPECT_THROW(load_script(folder_), FaultError);
}

}  // namespace
}  // namespace mrroc::mp
