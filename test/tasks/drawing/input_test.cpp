// What a run is given to draw.
#include "tasks/drawing/input.hpp"

#include <gtest/gtest.h>

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
