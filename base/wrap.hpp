// Cuts or wraps texts that are longer than a line.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace mrroc {

/// @return the text, when there is room, or as many of its words as there is room for, and ".."; nothing where that
///         would say nothing
[[nodiscard]] std::string cut(const std::string& text, int room);

/// @param width  characters of a line; a single word may be longer
/// @return the text in lines that end between words. What stands between backticks is one word: it is typed as it is
[[nodiscard]] std::vector<std::string> wrap(std::string_view text, int width);

}  // namespace mrroc
