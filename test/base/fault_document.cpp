#include "test/base/fault_document.hpp"

#include <fmt/core.h>

#include "base/fault.hpp"

namespace mrroc::test {
namespace {

constexpr const char* kHead = R"(# Errors

Made from the table in `base/fault_table.hpp` and from what tasks register in their `vocabulary.hpp`. After a change there:
`MRROC_UPDATE_DOCS=1 ./run test -R FaultTable`

Every error has one of three classes (MG 5):

- **non-fatal**: a wrong argument or a failed computation. It is refused with a reason; the effector goes on
  with what it did, and the task goes on or ends.
- **fatal**: the effector malfunctions. It stops safely and accepts nothing but a reset, which the task `manual` takes;
  every other task ends.
- **system**: communication or a process failed. The task ends, the drives brake, nothing is left running.

`ui_cli explain CODE` says the same in a terminal, and what follows from that very error. A program that ends with an error prints `error: CODE: what happened; what to do` as its last line on standard
error. Its exit status is 1 after a fault or a stop, 2 for a wrong input (nothing was started), 3 for a system
error.

| code | number | class | exit | what happened | what it mostly comes from | what to do |
| --- | --- | --- | --- | --- | --- | --- |
)";

}  // namespace

std::string fault_document() {
  std::string document = kHead;
  for (const FaultEntry& entry : all_faults()) {
    if (entry.code == FaultCode::none) continue;
    document += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", entry.name,
                            static_cast<int>(entry.code), to_string(entry.fault_class),
                            exit_status(entry.code), entry.text, entry.causes, entry.remedy);
  }
  return document;
}

}  // namespace mrroc::test
