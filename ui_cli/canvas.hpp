// A picture made of characters, drawn in memory before it is written to a terminal.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mrroc::ui {

/// Meaning of a character's looks; the terminal chooses the looks.
enum class Style : std::uint8_t { plain, title, heading, dim, good, warning, bad };

/// One character place.
struct Cell {
  char32_t glyph{U' '};       ///< takes one column
  Style style{Style::plain};  ///< of the character
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Size of a terminal [characters].
struct Size {
  int rows{};     ///< >= 0
  int columns{};  ///< >= 0
  friend bool operator==(const Size&, const Size&) = default;
};

/// Rows and columns are counted from 0. What is put outside is cut off, so nobody has to count.
class Canvas {
 public:
  /// Begins with blanks.
  explicit Canvas(Size size);

  /// @return as it was made with
  [[nodiscard]] Size size() const { return size_; }
  /// @param text printable ASCII; anything else becomes '?'
  /// @return the column after the text
  int put(int row, int column, std::string_view text, Style style = Style::plain);
  /// @param text one column per character
  int put(int row, int column, std::u32string_view text, Style style = Style::plain);
  /// Puts a text that ends before the column end.
  void put_right(int row, int end, std::string_view text, Style style = Style::plain);
  /// Gives a whole row the style.
  void paint(int row, Style style);

  /// @return the cell; a blank one outside
  [[nodiscard]] Cell cell(int row, int column) const;
  /// @return the row in UTF-8 without the blanks at its end
  [[nodiscard]] std::string text(int row) const;
  /// @return all rows, each ended by a line feed
  [[nodiscard]] std::string text() const;

 private:
  [[nodiscard]] bool inside(int row, int column) const;
  [[nodiscard]] std::size_t index(int row, int column) const;
  void set(int row, int column, char32_t glyph, Style style);

  Size size_;
  std::vector<Cell> cells_;
};

}  // namespace mrroc::ui
