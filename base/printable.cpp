#include "base/printable.hpp"

#include <cstddef>

namespace mrroc {
namespace {

/// What the second byte of a character may be, beside the first one: UTF-8 writes no character in two ways, and none that
/// is half of a pair of UTF-16.
struct Lead {
  unsigned char first, last;      // of the first byte
  unsigned char lowest, highest;  // of the second byte
  std::size_t size;               // of the character [bytes]
};
constexpr Lead kLeads[] = {{0xc2, 0xdf, 0x80, 0xbf, 2}, {0xe0, 0xe0, 0xa0, 0xbf, 3},
                           {0xe1, 0xec, 0x80, 0xbf, 3}, {0xed, 0xed, 0x80, 0x9f, 3},
                           {0xee, 0xef, 0x80, 0xbf, 3}, {0xf0, 0xf0, 0x90, 0xbf, 4},
                           {0xf1, 0xf3, 0x80, 0xbf, 4}, {0xf4, 0xf4, 0x80, 0x8f, 4}};

/// @return bytes of the character with which the text begins; 0: it begins with none of UTF-8
std::size_t character_size(std::string_view text) {
  const auto byte = [text](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  if (byte(0) < 0x80) return 1;
  for (const Lead& lead : kLeads) {
    if (byte(0) < lead.first || byte(0) > lead.last) continue;
    if (text.size() < lead.size || byte(1) < lead.lowest || byte(1) > lead.highest) return 0;
    for (std::size_t k = 2; k < lead.size; ++k)
      if (byte(k) < 0x80 || byte(k) > 0xbf) return 0;
    return lead.size;
  }
  return 0;
}

bool is_control(std::string_view character) {
  const auto c = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return c < ' ' || c == 0x7f;
  return c == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
}

}  // namespace

std::string without_controls(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    const std::string_view character = text.substr(0, size);
    if (size == 0 || is_control(character))
      result += '?';
    else
      result += character;
    text.remove_prefix(size == 0 ? 1 : size);
  }
  return result;
}

}  // namespace mrroc
