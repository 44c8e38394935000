// The data flow of REX fig. 6, found out by trying: which input buffers of c_1 each of its transition functions reads, and
// which output buffers they change.
#pragma once
#include <string>
#include <vector>

#include "tasks/rex_drive/locomotion.hpp"

namespace mrroc::test {

/// A buffer of the paper, and where it is here.
struct BufferName {
  std::string paper;  ///< "c_c1[plan]"; "-": the paper has none
  std::string here;   ///< below x or y: "x.c.plan"
};

/// One output of a behaviour.
struct Flow {
  int m{};               ///< of the behaviour
  std::string function;  ///< of the row that makes it: "f_cc"
  BufferName output;     ///< that is made
  std::vector<BufferName>
      inputs;   ///< whose change changes it in one of the images tried; empty: it is always the same
  bool kept{};  ///< in all images tried it is as it was
};

/// @return of every behaviour of kBehaviours all outputs, in their order
[[nodiscard]] std::vector<Flow> data_flows();

}  // namespace mrroc::test
