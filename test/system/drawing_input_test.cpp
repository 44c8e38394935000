// Bad input is refused before anything starts.
#include <gtest/gtest.h>

#include <iterator>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

std::string svg_of(const std::string& body) {
  return R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">)" + body + "</svg>";
}

class RefusedInput : public ::testing::Test {
 protected:
  /// @param words_of_it  what the last line of the standard error must say
  void refuses(const std::vector<std::string>& arguments, const std::vector<std::string>& words_of_it) {
    const auto end = run(folder_, "drawing", words({{"--run-dir", (folder_ / "run").string()}, arguments}));
    EXPECT_EQ(end.status, 2) << end.all();
    EXPECT_TRUE(end.last_err().starts_with("error: ")) << end.all();
    for (const auto& word : words_of_it)
      EXPECT_NE(end.last_err().find(word), std::string::npos) << word << " is not in: " << end.last_err();
    for (const auto& line : end.out) EXPECT_EQ(line.find("m = "), std::string::npos) << "it was started";
    EXPECT_FALSE(fs::exists(folder_ / "run")) << "nothing was started";
  }
  void refuses_drawing(const std::string& content, const std::vector<std::string>& words_of_it) {
    refuses({"--drawing", folder_.write("bad.svg", content)}, words_of_it);
  }

  Folder folder_;
};

TEST_F(RefusedInput, DrawingsThatAreNone) {
  refuses({"--drawing", (folder_ / "nowhere.svg").string()},
          {"bad_drawing", "nowhere.svg", "; check the name"});
  refuses({"--drawing", folder_.path().string()}, {"bad_drawing"});
  refuses_drawing("", {"bad_drawing", "empty"});
  refuses_drawing("this is no drawing", {"bad_drawing", "bad.svg"});
  refuses_drawing(svg_of("<path stroke='black' d='M 0 0 L'"), {"bad_drawing", "bad.svg"});
  refuses_drawing(svg_of("<path stroke='black' d='M 0 0 L 5 nonsense'/>"), {"bad_drawing", "bad.svg"});
  refuses_drawing(svg_of(""), {"bad_drawing", "bad.svg"});
}

TEST_F(RefusedInput, DrawingsThatAreTooLarge) {
  refuses({"--size", "250"}, {"bad_drawing", "250"});
  for (const char* size : {"-5", "0"}) refuses({"--size", size}, {"bad_drawing", "give a size above 0"});
  refuses({"--size", "nan"}, {"error: "});
  std::string points;
  for (int k = 0; k < 10'002; ++k)
    points += std::to_string(k % 100) + "," + std::to_string(k * 7 % 100) + " ";
  refuses_drawing(svg_of("<polyline stroke='black' fill='none' points='" + points + "'/>"),
                  {"bad_drawing", "10000"});
}

TEST_F(RefusedInput, DamagedRecordings) {
  refuses({"--load", (folder_ / "nowhere.recording").string()},
          {"bad_recording", "nowhere", "; check the name"});
  refuses({"--load", folder_.write("empty", "")}, {"bad_recording", "empty"});
  refuses({"--load", folder_.write("other", "something else\n")}, {"bad_recording", "other"});
  refuses({"--load", folder_.write("cut",
                                   "mrroc-drawing-recording 1\nmacrostep_s 0.02\nnodes 3\n"
                                   "x y z ax ay az pen\n0 0 0 0 0 0 paper_surface\n")},
          {"bad_recording", "cut:"});
}

TEST_F(RefusedInput, OptionsAndSettings) {
  refuses({"--speed", "0"}, {"bad_usage", "speed"});
  refuses({"--speed", "1e9"}, {"bad_usage", "up to 10000"});
  refuses({"--clock", "wall", "--speed", "2"}, {"bad_usage", "--clock wall"});
  refuses({"--seed", "-1"}, {"bad_usage", "--seed"});
  refuses({"--speed", "fast"}, {"bad_usage", "fast"});
  refuses({"--clock", "sundial"}, {"bad_usage", "clock"});
  refuses({"--colour", "red"}, {"bad_usage", "--colour"});
  refuses({"--session", "a name"}, {"bad_usage", "a name"});
  refuses({"--url", "tcp://here"}, {"bad_usage", "tcp"});
  refuses({"--set", "task.draw_forze=2"}, {"draw_forze", "draw_force"});
  refuses({"--set", "task.draw_force=much"}, {"draw_force"});
  refuses({"--set", "task.draw_force=-1"}, {"draw_force"});
  refuses({"--set", "task"}, {"task"});
  refuses({"--script", (folder_ / "nowhere.script").string()}, {"bad_script", "nowhere", "; check the name"});
  refuses({"--script", folder_.write("bad.script", "12 dance\n")}, {"bad_script", "dance"});
  refuses({"--config", (folder_ / "nowhere.toml").string()}, {"nowhere.toml", "; check the name"});
  refuses({"--config", folder_.write("bad.toml", "[task\n")}, {"bad.toml"});
  refuses({"--save", (folder_ / "nowhere" / "file").string()}, {"bad_usage", "nowhere"});
}

TEST_F(RefusedInput, AFolderThatHoldsSomething) {
  fs::create_directories(folder_ / "old");
  folder_.write("old/summary.json", "of somebody\n");
  const auto end = run(folder_, "drawing", {"--run-dir", (folder_ / "old").string()});
  EXPECT_EQ(end.status, 2) << end.all();
  EXPECT_TRUE(end.last_err().starts_with("error: bad_usage: ")) << end.last_err();
  EXPECT_NE(end.last_err().find("is not empty"), std::string::npos) << end.last_err();
  EXPECT_NE(end.last_err().find("choose another --run-dir"), std::string::npos) << end.last_err();
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "old"), {}), 1) << "it is left alone";
}

}  // namespace
}  // namespace mrroc::test
