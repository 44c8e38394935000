#include "ui_cli/terminal.hpp"

#include <langinfo.h>
#include <unistd.h>

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#define NCURSES_NOMACROS 1
#define NCURSES_WIDECHAR 1
#include <curses.h>

#include "base/fault.hpp"

#include "ui_cli/keys.hpp"

namespace mrroc::ui {
namespace {

static_assert(key::kDown == KEY_DOWN && key::kUp == KEY_UP && key::kLeft == KEY_LEFT &&
              key::kRight == KEY_RIGHT && key::kBackspace == KEY_BACKSPACE && key::kKeypadEnter == KEY_ENTER);

// Colour pairs of curses.
constexpr short kGood = 1;
constexpr short kWarning = 2;
constexpr short kBad = 3;

attr_t looks(Style style, bool colours) {
  switch (style) {
    case Style::plain:
      return A_NORMAL;
    case Style::title:
      return A_REVERSE;
    case Style::heading:
      return A_BOLD;
    case Style::dim:
      return A_DIM;
    case Style::good:
      return colours ? A_NORMAL : A_BOLD;
    case Style::warning:
      return A_BOLD;
    case Style::bad:
      return colours ? A_BOLD : A_BOLD | A_REVERSE;
  }
  return A_NORMAL;
}

short pair_of(Style style) {
  switch (style) {
    case Style::good:
      return kGood;
    case Style::warning:
      return kWarning;
    case Style::bad:
      return kBad;
    default:
      return 0;
  }
}

}  // namespace

struct Terminal::Screen {
  SCREEN* handle{};
  bool colours{};
};

Terminal::Terminal() : screen_(std::make_unique<Screen>()) {
  if (::isatty(STDIN_FILENO) == 0 || ::isatty(STDOUT_FILENO) == 0)
    throw FaultError(FaultCode::bad_usage, "the full-screen view needs a terminal as its input and output",
                     "use `ui_cli status` or `ui_cli status --json` in scripts");
  std::setlocale(LC_ALL, "");
  screen_->handle = ::newterm(nullptr, stdout, stdin);
  if (!screen_->handle) {
    const char* const type = std::getenv("TERM");
    throw FaultError(FaultCode::bad_usage,
                     std::string("the terminal type '") + (type ? type : "") + "' is not known",
                     "set TERM to the type of this terminal, for example TERM=xterm");
  }
  ::raw();  // Ctrl-C is a key, so that leaving always gives the terminal back
  ::noecho();
  ::nodelay(stdscr, TRUE);
  ::keypad(stdscr, TRUE);
  ::set_escdelay(25);
  ::curs_set(0);
  screen_->colours = ::has_colors() && ::start_color() == OK;
  if (screen_->colours) {
    ::use_default_colors();
    ::init_pair(kGood, COLOR_GREEN, -1);
    ::init_pair(kWarning, COLOR_YELLOW, -1);
    ::init_pair(kBad, COLOR_RED, -1);
  }
}

Terminal::~Terminal() {
  ::endwin();
  ::delscreen(screen_->handle);
}

Size Terminal::size() const { return {getmaxy(stdscr), getmaxx(stdscr)}; }

Glyphs Terminal::glyphs() const {
  return std::string_view(::nl_langinfo(CODESET)) == "UTF-8" ? Glyphs::unicode : Glyphs::ascii;
}

void Terminal::show(const Canvas& canvas) {
  ::werase(stdscr);
  const Size size = canvas.size();
  for (int row = 0; row < size.rows; ++row) {
    for (int column = 0; column < size.columns; ++column) {
      const Cell cell = canvas.cell(row, column);
      if (cell == Cell{}) continue;
      const wchar_t text[2]{static_cast<wchar_t>(cell.glyph), L'\0'};
      cchar_t c;
      ::setcchar(&c, text, looks(cell.style, screen_->colours), screen_->colours ? pair_of(cell.style) : 0,
                 nullptr);
      ::mvwadd_wch(stdscr, row, column, &c);
    }
  }
  ::wrefresh(stdscr);
}

std::optional<int> Terminal::key() {
  const int key = ::wgetch(stdscr);
  if (key == ERR) return std::nullopt;
  return key;
}

}  // namespace mrroc::ui
