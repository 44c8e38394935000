#include "base/target/target_config.hpp"

namespace mrroc {

Board read_board(const Config& config) {
  const Config t = config.section("chessboard");
  Board b;
  b.columns = t.integer("columns", b.columns, {3, 20}, "inner corners along a row");
  b.rows = t.integer("rows", b.rows, {3, 20}, "inner corners along a column");
  b.square = t.number("square", b.square, {0.002, 1}, "m");
  b.margin = t.number("margin", b.margin, {0, 1}, "m");
  if (b.columns % 2 == 0 || b.rows % 2 != 0)
    throw ConfigError(
        {"chessboard", 0, 0}, "chessboard.columns",
        "the inner corners along a row must be odd and those along a column even: otherwise the board "
        "looks the same upside down, or is to be read the other way round");
  return b;
}

Tag read_tag(const Config& config) {
  const Config t = config.section("apriltag");
  Tag tag;
  tag.id = t.integer("id", tag.id, {0, 586});
  tag.edge = t.number("edge", tag.edge, {0.002, 2}, "m");
  tag.margin = t.number("white", tag.edge / 4, {0, 1}, "m");
  return tag;
}

}  // namespace mrroc
