#include "base/instructions.hpp"

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

namespace mrroc {
namespace {

constexpr std::size_t kMost = 32;
constinit std::array<InstructionSet, kMost> g_sets{};  // changes before main() begins only
constinit std::size_t g_count = 0;

}  // namespace

RegisteredInstructions::RegisteredInstructions(const InstructionSet& set) noexcept {
  if (g_count == kMost) {
    std::fputs("error: internal_error: too many tasks register instructions\n", stderr);
    std::abort();
  }
  g_sets[g_count++] = set;
}

std::span<const InstructionSet> instruction_sets() noexcept { return std::span(g_sets).first(g_count); }

std::span<const std::string_view> instruction_verbs(std::string_view task) noexcept {
  for (const InstructionSet& set : instruction_sets())
    if (set.task == task) return set.verbs;
  return {};
}

}  // namespace mrroc
