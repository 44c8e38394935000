// The contract of a task whose arms work on their own takes three lines:
//
//   struct MyTask : SoloTask<my::Arm, my::kRows> { static constexpr const char* kFolder = "tasks/my"; };
//   INSTANTIATE_TYPED_TEST_SUITE_P(My, TaskContract, MyTask);
#pragma once
#include "ecp/solo.hpp"
#include "test/contract/task_contract.hpp"

namespace mrroc::contract {

/// @tparam A  agent @tparam rows  its table, executed from the first row to the last
template <class A, const auto& rows>
struct SoloTask {
  using Agent = A;
  static auto behaviours() { return rows; }
  static Outcome run(typename A::X& x, auto& port) {
    return ecp::execute_rows<A>(std::span<const Motion<A>>(rows), x, port);
  }
  static void configure(const Config&) {}
};

}  // namespace mrroc::contract
