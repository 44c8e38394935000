// Input of a run: the drawing.
#include "tasks/drawing/input.hpp"

#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "test/tasks/drawing/folder.hpp"

namespace mrroc::drawing {
namespace {

TEST(Input, LoadsARecordingWithMoreInkThanADrawingMayHavePoints) {
  Taught taught{Recording(0.02).appended({{}, PenState::paper_surface}), {}};
  for (std::size_t k = 0; k <= kMaxPoints; ++k)
    taught.ink.push_back({0, 0.002 * static_cast<double>(k), 1e-3 * static_cast<double>(k), 0});
  const Folder folder;
  save(folder / "long", taught);
  InputOptions options;
  options.load = folder / "long";
  const Input input = read_input(options);
  EXPECT_EQ(input.taught, taught);
  ASSERT_EQ(input.drawing.size(), 1U);
}

TEST(Input, TellsHowMuchThereIsToDraw) {
  Input input;
  input.name = "a.svg";
  input.drawing = {{Point(0, 0), Point(30, 40)}};
  EXPECT_EQ(input.about(), "a.svg: 1 stroke, 2 points, 50 mm");
  input.drawing.push_back({Point(0, 0), Point(0, 10), Point(10, 10)});
  EXPECT_EQ(input.about(), "a.svg: 2 strokes, 5 points, 70 mm");
}

TEST(Input, AFolderIsNoFileToSaveIn) {
  const Folder folder;
  InputOptions options;
  options.save = folder / "";
  EXPECT_THROW(read_input(options), FaultError);
}

TEST(Input, RefusesARecordingThatLeavesTheSheet) {
  Taught taught{Recording(0.02).appended({{}, PenState::paper_surface}), {{0, 0, 0, 0}, {0, 0.002, 101, 0}}};
  const Folder folder;
  save(folder / "off", taught);
  InputOptions options;
  options.load = folder / "off";
  EXPECT_THROW(read_input(options), FileError);
}

}  // namespace
}  // namespace mrroc::drawing
