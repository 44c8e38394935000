// Makes text from files, messages and command lines safe to print on a terminal.
#pragma once
#include <string>
#include <string_view>

namespace mrroc {

/// @return the text with '?' for each control character (ASCII's, and those that UTF-8 writes as C2 80 to C2 9F) and for each
///         byte that is no part of a character in UTF-8, so that it cannot speak to the terminal; letters of any language
///         stay
[[nodiscard]] std::string without_controls(std::string_view text);

}  // namespace mrroc
