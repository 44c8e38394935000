// The parts of docs/rex.md that are made from the code: figures 3-8 of REX as tables.
#pragma once
#include <string>
#include <vector>

namespace mrroc::test {

/// A part of the document, between the lines `<!-- made: NAME -->` and `<!-- end: NAME -->`.
struct MadePart {
  std::string name;  ///< "figure 3"
  std::string text;  ///< Markdown
};

/// @return all parts, in the order of the document
[[nodiscard]] std::vector<MadePart> rex_tables();

/// @return the document with these parts in their places @throws std::runtime_error  a place is missing
[[nodiscard]] std::string with_parts(std::string document, const std::vector<MadePart>& parts);

}  // namespace mrroc::test
