// Manual operation at the full screen: keys become instructions, readings a picture.
#include "ui_cli/manual_page.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "base/link/channel.hpp"
#include "base/link/memory_bus.hpp"
#include "base/link/text.hpp"
#include "base/msg/convert.hpp"
#include "mrroc/manual_words_t.hpp"
#include "test/ui_cli/fake_task.hpp"
#include "ui_cli/keys.hpp"
#include "ui_cli/panel.hpp"

namespace mrroc::test {
namespace {

using namespace std::chrono_literals;
using namespace ui::key;

ui::ManualPage page() {
  return ui::ManualPage(
      {{.name = "arm1", .axes = 6, .presets = {"front", "0"}}, {.name = "arm2", .axes = 7, .presets = {}}});
}

EffectorReply reading() {
  EffectorReply r;
  r.state = DriverState::holding;
  r.position_known = true;
  for (std::size_t k = 0; k < 8; ++k) r.joints[k] = 0.1 * static_cast<double>(k);
  r.T_0E = {0.5, 0.25, 1, 0, 0, 1.5};
  r.F_a.v[2] = -3.25;
  r.gripper = 0.06;
  return r;
}

/// @return what the last of the keys asks of the task
std::string words(ui::ManualPage& p, const std::string& keys, std::initializer_list<int> more = {}) {
  ui::ManualDeed deed;
  for (const char k : keys) deed = p.key(k);
  for (const int k : more) deed = p.key(k);
  EXPECT_TRUE(deed.known);
  return deed.words;
}

TEST(ManualPage, JogsTheChosenAxisOfTheChosenArmInEverySpace) {
  auto p = page();
  EXPECT_EQ(words(p, "", {kRight}), "jog arm1 joints 0.05 0 0 0 0 0 speed 0.15");
  EXPECT_EQ(words(p, "2", {kUp, kLeft}), "jog arm2 joints 0 0 0 0 0 0 -0.05 speed 0.15");
  EXPECT_EQ(words(p, "", {kDown, kRight}), "jog arm2 joints 0.01 0 0 0 0 0 0 speed 0.15")
      << "a track is in metres";
  EXPECT_EQ(words(p, "c+", {kRight}), "jog arm2 euler 0.02 0 0 0 0 0 speed 0.15");
  EXPECT_EQ(words(p, "c->", {kDown, kDown, kRight}), "jog arm2 angle-axis 0 0 0.01 0 0 0 speed 0.3");
  EXPECT_EQ(words(p, "1c<", {kRight}), "jog arm1 motors 0 0 5 0 0 0 speed 0.15");
}

TEST(ManualPage, StepsAndSpeedsHaveEnds) {
  auto p = page();
  EXPECT_EQ(words(p, "--------<<<<<<<", {kRight}), "jog arm1 joints 0.005 0 0 0 0 0 speed 0.05");
  EXPECT_EQ(words(p, "+++++++++>>>>>>>", {kRight}), "jog arm1 joints 0.5 0 0 0 0 0 speed 1");
}

TEST(ManualPage, AKeyAndEnterAreOneInstructionToOneArmOrAll) {
  auto p = page();
  EXPECT_EQ(words(p, "h", {kEnter}), "home arm1");
  EXPECT_EQ(words(p, "0h", {kReturn}), "home all");
  EXPECT_EQ(words(p, "b", {kEnter}), "bias all");
  EXPECT_EQ(words(p, "2z", {kEnter}), "reset arm2");
  EXPECT_EQ(words(p, "h", {kEscape}), "");
  EXPECT_FALSE(p.typing());
  EXPECT_EQ(words(p, " "), "stop arm2") << "at once";
  EXPECT_FALSE(p.key('0').leave);
  EXPECT_NE(p.key(kRight).refusal, "") << "coordinates of several arms are not the same";
  EXPECT_NE(p.key('a').refusal, "");
  EXPECT_TRUE(p.key('m').leave);
  EXPECT_FALSE(p.key('e').known) << "keys of the whole program are not taken";
}

TEST(ManualPage, AnInstructionThatIsTypedWithoutItsColonDoesNothingBeforeEnter) {
  for (const std::string line : {"home arm2", "bias all", "gripper arm2 0.05", "weight arm1 3",
                                 "jog arm1 motors 1", "stop arm1", "servo arm1 1", "tool arm1 0 0 0 0 0 0"}) {
    auto p = page();
    for (const char k : line) {
      const ui::ManualDeed deed = p.key(k);
      EXPECT_TRUE(deed.known && deed.words.empty()) << line << " at " << k;
    }
    EXPECT_EQ(p.key(kEnter).words, line);
  }
  auto p = page();
  words(p, "hx");
  EXPECT_NE(p.key(kEnter).refusal.find("`home arm1` needs no 'x'"), std::string::npos);
}

TEST(ManualPage, AsksForWhatAnInstructionNeedsBesides) {
  auto p = page();
  EXPECT_EQ(words(p, "g0.05", {kReturn}), "gripper arm1 0.05");
  EXPECT_EQ(words(p, "ofront", {kEnter}), "preset arm1 front speed 0.15");
  EXPECT_EQ(words(p, "w0 0 0.25 0 0 0", {kEnter}), "tool arm1 0 0 0.25 0 0 0");
  EXPECT_EQ(words(p, "W12.5", {kEnter}), "weight arm1 12.5");
  EXPECT_EQ(words(p, "k1", {kEnter}), "model arm1 1");
  EXPECT_EQ(words(p, "v0 2", {kEnter}), "servo arm1 0 2");
  EXPECT_EQ(words(p, ":end", {kEnter}), "end");
  EXPECT_EQ(words(p, "gx", {kBackspace, '0', '.', '1', kKeypadEnter}), "gripper arm1 0.1");
  EXPECT_EQ(words(p, "gem"), "");
  EXPECT_TRUE(p.typing());
  EXPECT_NE(p.prompt().find("em"), std::string::npos) << "every key belongs to the text";
  EXPECT_EQ(words(p, "", {kEscape}), "");
  EXPECT_FALSE(p.typing());
  EXPECT_EQ(words(p, "g", {kEnter}), "") << "nothing typed, nothing done";
}

TEST(ManualPage, ALineIsUnderstoodHoweverItIsTyped) {
  const auto typed = [](const std::string& keys) {
    auto p = page();
    return words(p, keys, {kEnter});
  };
  for (const char* line : {":home arm1", "::home arm1", ":  home   arm1 ", ":ui_cli manual home arm1"})
    EXPECT_EQ(typed(line), "home arm1") << line;
  EXPECT_EQ(typed("g gripper arm1 0.06"), "gripper arm1 0.06");
  EXPECT_EQ(typed("o front "), "preset arm1 front speed 0.15");
  EXPECT_EQ(typed("o front speed 1"), "preset arm1 front speed 1");
  EXPECT_EQ(typed(":   "), "");
  for (const char* line : {":show arm1", ":load file", ":home arm1 --json"}) {
    auto p = page();
    for (const char* k = line; *k != 0; ++k) static_cast<void>(p.key(*k));
    EXPECT_NE(p.key(kEnter).refusal.find("ui_cli manual"), std::string::npos) << line;
  }
}

TEST(ManualPage, AnInstructionThatIsTooLongIsRefusedWithTheLimitAndNotCut) {
  auto p = page();
  const std::string line = ":weight arm1 " + std::string(300, '1');
  for (const char k : line) static_cast<void>(p.key(k));
  const ui::ManualDeed deed = p.key(kEnter);
  EXPECT_EQ(deed.words, "");
  EXPECT_NE(deed.refusal.find("at most 239 characters, and this one 312"), std::string::npos) << deed.refusal;
}

TEST(ManualPage, GoesToAnAbsoluteCoordinateFromWhereTheArmIs) {
  auto p = page();
  words(p, "a0.7");
  EXPECT_NE(p.key(kEnter).refusal, "") << "where the arm is has not been told";
  p.show("arm1", reading());
  p.key(kDown);
  EXPECT_EQ(words(p, "a-0.7", {kEnter}),
            "move arm1 joints 0.000000 -0.7 0.200000 0.300000 0.400000 0.500000 speed 0.15");
  EXPECT_EQ(words(p, "cca0.3", {kEnter}),
            "move arm1 angle-axis 0.500000 0.3 1.000000 0.000000 0.000000 1.500000 speed 0.15");
  words(p, "a1e");
  EXPECT_NE(p.key(kEnter).refusal.find("'1e' is not a number"), std::string::npos);
}

TEST(ManualPage, BeforeHomingThereAreNoJointsToShowOrToGoFrom) {
  auto p = page();
  EffectorReply r = reading();
  r.state = DriverState::not_synchronised;
  r.position_known = false;
  p.show("arm1", r);
  ui::Canvas c({24, 80});
  p.draw(c, 1, 20);
  EXPECT_EQ(c.text().find("0.1000"), std::string::npos) << c.text();
  words(p, "a0.7");
  EXPECT_NE(p.key(kEnter).refusal.find("does not know its position"), std::string::npos);
}

TEST(ManualPage, ShowsTheModelAndTheServoThatTheDriverTells) {
  auto p = page();
  EffectorReply r = reading();
  const auto shown = [&] {
    p.show("arm2", r);  // of seven axes: the most that has to fit
    ui::Canvas c({24, 80});
    p.draw(c, 1, 16);
    return c.text();
  };
  EXPECT_EQ(shown().find("servo"), std::string::npos) << "nothing has been told\n" << shown();
  r.robot_model.set_servo_algorithm = 0b1111111;
  r.robot_model.kinematic_model = 3;
  r.robot_model.servo_parameter_set.fill(1);
  EXPECT_NE(shown().find("3  servo 0 1"), std::string::npos) << shown();
  EXPECT_NE(shown().find("fault"), std::string::npos) << shown();
  r.robot_model.servo_algorithm[6] = 1;
  EXPECT_NE(shown().find("servo differs"), std::string::npos) << shown();
}

TEST(ManualPage, ShowsTheArmsAndKeepsTheChosenAxisOnAnySize) {
  auto p = page();
  p.show("arm1", reading());
  p.show("nobody", reading());
  p.key('2');
  p.key(kUp);
  for (int rows = 1; rows < 40; ++rows)
    for (const int columns : {1, 20, 60, 80, 200}) {
      ui::Canvas c({rows, columns});
      p.draw(c, 1, rows - 4);
      p.draw_keys(c, rows - 3);
      if (rows <= 9 || columns < 60) continue;
      EXPECT_NE(c.text().find("> axis 7"), std::string::npos) << c.text();
    }
  ui::Canvas c({24, 80});
  p.draw(c, 1, 20);
  p.draw_keys(c, 21);
  for (const char* text :
       {"arm1", "holding", "not heard yet", "-3.25", "0.0600", "0.5000", "E-STOP", "m back", "stop arm"})
    EXPECT_NE(c.text().find(text), std::string::npos) << text << "\n" << c.text();
}

TEST(ManualPage, ReadsTheArmsOfARunFolder) {
  std::string pattern = ::testing::TempDir() + "/manual.XXXXXX";
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  EXPECT_TRUE(ui::manual_arms(folder).empty());
  std::ofstream(folder / "config.toml")
      << "[robots]\norder = ['a', 'b']\n[robots.b]\naxes = 7\n[robots.b.presets]\nfront = [1]\n";
  const auto arms = ui::manual_arms(folder);
  ASSERT_EQ(arms.size(), 2U);
  EXPECT_EQ(arms[1].axes, 7);
  EXPECT_EQ(arms[1].presets, std::vector<std::string>{"front"});
  std::ofstream(folder / "config.toml") << "no toml";
  EXPECT_TRUE(ui::manual_arms(folder).empty());
  std::filesystem::remove_all(folder);
}

/// The full screen with the task `manual` on the other side.
class ManualPanel : public ::testing::Test {
 protected:
  ManualPanel() {
    task_status_t m = drawing_status();
    link::put_text(m.task, "manual");
    m.state = static_cast<int>(TaskState::running);
    task.publish(m);
    pass(20ms);
  }
  void pass(std::chrono::milliseconds time) {
    for (const auto end = now + time; now < end; now += 10ms) {
      task.poll();
      while (const auto m = in.take()) {
        if (heard.empty() || heard.back() != link::get_text(m->text))
          heard.push_back(link::get_text(m->text));
        manual_answer_t a{};
        a.id = m->id;
        a.state = state;
        link::put_text(a.text, state == 0 ? "arm1 is busy" : "done");
        out.publish(a, 0);
      }
      client.receive(0ms);
      panel.update(now);
    }
  }
  void press(int key) {
    panel.key(key, now);
    pass(30ms);
  }
  std::string notice() { return panel.picture({24, 160}, now).text(20); }

  link::MemoryHub hub;
  std::unique_ptr<link::Bus> task_bus = hub.open();
  std::unique_ptr<link::Bus> bus = hub.open();
  FakeTask task{*task_bus, "s", 7};
  link::Queue<manual_words_t> in{*task_bus, {link::Group::agents, "s.manual.words"}, 7};
  link::Outbox<manual_answer_t> out{*task_bus, {link::Group::agents, "s.manual.answer"}, 7};
  std::vector<std::string> heard;
  int state{2};
  ui::Client client{*bus, {"s", 7, {}, "manual", {}, 4711}};
  ui::Clock::time_point now{1h};
  ui::Panel panel{*bus, client, ui::Glyphs::ascii, now};
};

TEST_F(ManualPanel, SendsInstructionsAndTellsWhatBecameOfThem) {
  press('m');
  press('h');
  EXPECT_TRUE(heard.empty()) << "a letter alone moves nothing";
  press(kEnter);
  EXPECT_EQ(heard, std::vector<std::string>{"home arm1"});
  EXPECT_EQ(notice(), " home arm1: done");
  state = 0;
  press('b');
  press(kEnter);
  EXPECT_EQ(notice(), " bias arm1 refused: arm1 is busy");
  state = 1;
  press(kRight);
  EXPECT_NE(notice().find("is being done"), std::string::npos) << notice();
  state = 2;
  pass(300ms);
  EXPECT_NE(notice().find(": done"), std::string::npos) << notice();
}

TEST_F(ManualPanel, GoingOnAfterAPauseIsAskedForWhereAnRMayBeALetterOfAWord) {
  press('m');
  for (const char k : std::string("rt")) press(k);
  EXPECT_TRUE(task.obeyed.empty());
  EXPECT_EQ(notice(), " not resumed");
  press('r');
  press('y');
  EXPECT_EQ(task.obeyed, std::vector{OperatorOrder::resume});
}

TEST_F(ManualPanel, HasAHelpOfItsOwnKeysThatFitsASmallTerminal) {
  const auto screen = [&] { return panel.picture({15, 60}, now); };
  press('?');
  EXPECT_NE(screen().text().find("resume"), std::string::npos) << "outside of the page: that of the task\n";
  press('?');
  press('m');
  press('?');
  const std::string help = screen().text();
  for (const char* what : {"jog", "preset", "absolute coordinate", "bias the force", "Any key goes back"})
    EXPECT_NE(help.find(what), std::string::npos) << what << " is not in\n" << help;
  EXPECT_EQ(help, [&] {
    std::string wide;  // nothing is cut
    const ui::Canvas c = panel.picture({15, 61}, now);
    for (int row = 0; row < 15; ++row)
      wide += (row == 0 || row == 14 ? screen().text(row) : c.text(row)) + "\n";
    return wide;
  }());
  press('?');
  EXPECT_NE(screen().text().find("MANUAL"), std::string::npos) << "back at the page";
  EXPECT_TRUE(heard.empty());
}

TEST_F(ManualPanel, TheEmergencyStopIsOnEveryPageAndInATextWithControl) {
  const auto screen = [&] { return panel.picture({24, 80}, now).text(); };
  press('m');
  press('g');
  press('e');
  EXPECT_TRUE(task.obeyed.empty()) << "it is a letter of a text";
  EXPECT_NE(screen().find("Ctrl-E E-STOP"), std::string::npos) << screen();
  EXPECT_EQ(screen().find("e E-STOP"), std::string::npos) << "no key is shown that means something else\n"
                                                          << screen();
  press(kControlE);
  EXPECT_EQ(task.obeyed.size(), 1U);
  press(kEscape);
  press('e');
  EXPECT_EQ(task.obeyed, std::vector(2, OperatorOrder::emergency_stop));
  press('m');
  EXPECT_NE(panel.picture({24, 80}, now).text().find("PROCESS"), std::string::npos) << "back at the task";
  press('h');
  EXPECT_TRUE(heard.empty()) << "keys of the page mean nothing outside of it";
}

}  // namespace
}  // namespace mrroc::test
