// What is true of the plant stands in [sim]: no controller reads it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "test/base/layers.hpp"

namespace mrroc::test {
namespace {

const std::filesystem::path kRoot = MRROC_SOURCE_DIR;

struct Reader {
  const char* path;
  const char* why;
};

/// Files outside of the simulator that name its keys or read its world, and decide nothing for a controller by it.
constexpr std::array kReaders{
    Reader{"base/ground_area.cpp", "the ground of figures and pictures of platforms"},
    Reader{"ui_cli/view/scene.cpp", "the viewer shows the cell as it is"},
    Reader{"mp/parameter_list.cpp", "it lists keys"},
    Reader{"tasks/drawing/cell/paper.cpp", "the sheets of the pictures"},
    Reader{"tasks/edge_follow/plots.cpp", "the plates of a picture"},
    Reader{"tasks/ball/cell/ball_cell.cpp", "the sheet in whose axes a simulated hand pushes"},
    Reader{"tasks/calibrate_cell/cell/cell.cpp", "figures compare with it what a run has found"},
    Reader{"tasks/guide/cell/guide_cell.cpp",
           "the way of a simulated hand; where the arms begin, which is told"},
    Reader{"tasks/haptic/cell/haptic_cell.cpp",
           "the way of a simulated hand; where the arms begin, which is told"},
    Reader{"tasks/visual_servo/cell/tool_camera.cpp", "figures: what the tool's camera could know"},
    Reader{"tasks/rex_drive/options.cpp", "it sets the ground that an option asks for"},
    Reader{"tasks/rex_drive/drive_case.cpp", "it compares what two runs were given"},
    Reader{"tasks/box_push/options.cpp", "it sets where the box stands"},
};

/// Below these the plant is made, started or tried.
constexpr std::array<std::string_view, 4> kOfThePlant{"sim/", "launch/", "test/", "bench/"};

bool names_the_truth(const std::string& line) {
  const std::size_t comment = line.find("//");
  for (const char* word : {"\"sim.", "section(\"sim", "tables(\"sim", "read_world(", "read_camera_world(",
                           "read_true_", "sim::read_"})
    if (const std::size_t at = line.find(word); at != std::string::npos && at < comment) return true;
  return false;
}

TEST(Tree, ReadsTheTruthInTheSimulatorOnly) {
  std::set<std::string> readers;
  for (const auto& path : project_files(kRoot)) {
    const std::string name = path.string();
    if (path.extension() != ".cpp" && path.extension() != ".hpp") continue;
    if (std::ranges::any_of(kOfThePlant, [&](std::string_view folder) { return name.starts_with(folder); }))
      continue;
    for (const std::string& line : lines_of(kRoot / path))
      if (names_the_truth(line)) readers.insert(name);
  }
  for (const Reader& known : kReaders)
    EXPECT_EQ(readers.erase(known.path), 1U) << known.path << ": " << known.why;
  for (const std::string& other : readers)
    ADD_FAILURE()
        << other
        << " reads what is true of the plant; give controllers a key of their own for what they believe";
}

TEST(Tree, FindsReadersOfTheTruth) {
  EXPECT_TRUE(names_the_truth("  config.number(\"sim.paper.stiffness\", 1e4)"));
  EXPECT_TRUE(names_the_truth("  config.section(\"sim\")"));
  EXPECT_TRUE(names_the_truth("  sim::read_world(config)"));
  EXPECT_TRUE(names_the_truth("  sim::read_camera_world(config, arms, {})"));
  EXPECT_TRUE(names_the_truth("  read_true_body(config)"));
  EXPECT_TRUE(names_the_truth("  read_true_artefact(config)"));
  EXPECT_TRUE(names_the_truth("  sim::read_pads(config)"));
  EXPECT_FALSE(names_the_truth("#include \"sim/world.hpp\""));
  EXPECT_FALSE(names_the_truth("  // as \"sim.paper.stiffness\" says"));
}

}  // namespace
}  // namespace mrroc::test
