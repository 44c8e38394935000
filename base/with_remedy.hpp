// What happened and what to do about it, in one line.
#pragma once
#include <string>
#include <string_view>

namespace mrroc {

/// @param what    happened, such as "no 'a'; did you mean 'b'?"
/// @param remedy  what to do, such as "look at --help"
/// @return both with a semicolon between them; behind a question the remedy is a sentence of its own
[[nodiscard]] std::string with_remedy(const std::string& what, std::string_view remedy);

}  // namespace mrroc
