// Characters of a text in UTF-8, counted as a person sees them, and blanks between them.
#pragma once
#include <algorithm>
#include <string_view>

namespace mrroc::cube {

/// Characters that separate words.
inline constexpr std::string_view kBlanks = " \t\r\n";

/// @return whether a byte goes on with the character before it
constexpr bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80; }

/// @return how many characters a text has
constexpr std::size_t characters(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, continues_character));
}

/// @param k  byte at which it begins, inside of the text @return the bytes of the character
constexpr std::string_view character_at(std::string_view text, std::size_t k) {
  std::size_t end = k + 1;
  while (end < text.size() && continues_character(text[end])) ++end;
  return text.substr(k, end - k);
}

/// @return whether a character is an apostrophe as typed or as typeset, or a prime
constexpr bool is_apostrophe(std::string_view character) {
  return character == "'" || character == "\u2019" || character == "\u2032";
}

}  // namespace mrroc::cube
