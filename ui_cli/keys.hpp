// Keys that are not characters, with the numbers that curses gives them.
#pragma once

namespace mrroc::ui {

/// Numbers of keys, as Terminal::key() returns them.
namespace key {
/// With the control key, and what the main part of the keyboard gives.
inline constexpr int kControlC = 3;
inline constexpr int kControlE = 5;
inline constexpr int kEnter = '\n';
inline constexpr int kReturn = '\r';
inline constexpr int kEscape = 27;
inline constexpr int kDelete = 127;
/// Arrows, and what curses has numbers of its own for.
inline constexpr int kDown = 0402;
inline constexpr int kUp = 0403;
inline constexpr int kLeft = 0404;
inline constexpr int kRight = 0405;
inline constexpr int kBackspace = 0407;
inline constexpr int kKeypadEnter = 0527;
}  // namespace key

}  // namespace mrroc::ui
