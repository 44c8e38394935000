// The document that is made from the state automaton.
#pragma once
#include <string>

namespace mrroc::edp::test {

/// @return text of docs/automaton.md
std::string automaton_document();

}  // namespace mrroc::edp::test
