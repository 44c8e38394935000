// The only code that calls curses.
#pragma once
#include <memory>
#include <optional>

#include "ui_cli/canvas.hpp"
#include "ui_cli/strip_chart.hpp"

namespace mrroc::ui {

/// The terminal in full-screen mode, from construction to destruction; one at a time. Works without colours,
/// and without UTF-8.
class Terminal {
 public:
  /// @throws FaultError bad_usage: standard input or output is no terminal, or one of unknown type
  Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  /// Gives the terminal back as it was.
  ~Terminal();

  /// @return the present size, after a resize the new one
  [[nodiscard]] Size size() const;
  /// @return which characters it can show, by the locale
  [[nodiscard]] Glyphs glyphs() const;
  /// Replaces all that is on the screen.
  void show(const Canvas& canvas);
  /// @return the next key that was pressed, also Ctrl-C as 3, or nothing; does not wait
  std::optional<int> key();

 private:
  struct Screen;
  std::unique_ptr<Screen> screen_;
};

}  // namespace mrroc::ui
