// docs/faults.md, made from the table of errors.
#pragma once
#include <string>

namespace mrroc::test {

/// @return the whole text of docs/faults.md
[[nodiscard]] std::string fault_document();

}  // namespace mrroc::test
