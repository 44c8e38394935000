#include "ui_cli/canvas.hpp"

#include <algorithm>

namespace mrroc::ui {
namespace {

void append_utf8(std::string& text, char32_t c) {
  const auto tail = [&](int shift) { text += static_cast<char>(0x80 | (c >> shift & 0x3f)); };
  if (c < 0x80) {
    text += static_cast<char>(c);
  } else if (c < 0x800) {
    text += static_cast<char>(0xc0 | c >> 6);
    tail(0);
  } else if (c < 0x10000) {
    text += static_cast<char>(0xe0 | c >> 12);
    tail(6);
    tail(0);
  } else {
    text += static_cast<char>(0xf0 | c >> 18);
    tail(12);
    tail(6);
    tail(0);
  }
}

}  // namespace

Canvas::Canvas(Size size)
    : size_{std::max(size.rows, 0), std::max(size.columns, 0)},
      cells_(static_cast<std::size_t>(size_.rows) * static_cast<std::size_t>(size_.columns)) {}

bool Canvas::inside(int row, int column) const {
  return row >= 0 && row < size_.rows && column >= 0 && column < size_.columns;
}

std::size_t Canvas::index(int row, int column) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_.columns) +
         static_cast<std::size_t>(column);
}

void Canvas::set(int row, int column, char32_t glyph, Style style) {
  if (inside(row, column)) cells_[index(row, column)] = {glyph, style};
}

int Canvas::put(int row, int column, std::string_view text, Style style) {
  for (const char c : text) set(row, column++, c >= ' ' && c <= '~' ? static_cast<char32_t>(c) : U'?', style);
  return column;
}

int Canvas::put(int row, int column, std::u32string_view text, Style style) {
  for (const char32_t c : text) set(row, column++, c, style);
  return column;
}

void Canvas::put_right(int row, int end, std::string_view text, Style style) {
  put(row, end - static_cast<int>(text.size()), text, style);
}

void Canvas::paint(int row, Style style) {
  for (int column = 0; column < size_.columns; ++column) set(row, column, cell(row, column).glyph, style);
}

Cell Canvas::cell(int row, int column) const {
  return inside(row, column) ? cells_[index(row, column)] : Cell{};
}

std::string Canvas::text(int row) const {
  std::string result;
  for (int column = 0; column < size_.columns; ++column) append_utf8(result, cell(row, column).glyph);
  return result.substr(0, result.find_last_not_of(' ') + 1);
}

std::string Canvas::text() const {
  std::string result;
  for (int row = 0; row < size_.rows; ++row) result += text(row) + "\n";
  return result;
}

}  // namespace mrroc::ui
