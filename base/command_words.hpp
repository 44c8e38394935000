// Texts about command lines, without parsing: examples, help, and hints at words that do not exist.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace mrroc {

class FaultError;

/// Lines that a program understands, from which its errors take what to type.
using Examples = std::vector<std::string>;

/// @return whether -h or --help is among the words before "--"
[[nodiscard]] bool asks_for_help(const std::vector<std::string>& words);

/// Examples at the end of a help: lines that begin as typed() wants it, and what they do.
using ExplainedLines = std::vector<std::pair<std::string, std::string>>;

/// @return them as typed(), below each other, with what they do in a column of its own
[[nodiscard]] std::string explained(ExplainedLines lines);

/// @param kind  "option" or "command"
/// @param near  what was probably meant; empty: nobody knows
/// @return bad_usage that names both
[[nodiscard]] FaultError no_such_word(const std::string& kind, const std::string& word,
                                      const std::string& near);

/// @return whether a word is of the form KEY=VALUE
[[nodiscard]] bool is_setting(const std::string& word);

/// @return what to type: the first example that begins like the command and has the word in it, or has the word
///         only; without one, where to look
[[nodiscard]] std::string what_to_type(const Examples& examples, const std::string& command,
                                       const std::string& word);

/// @param names  of one thing or several
/// @return "A, B and C"
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

}  // namespace mrroc
