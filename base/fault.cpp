#include "base/fault.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <type_traits>

#include "base/command_hint.hpp"
#include "base/fault_table.hpp"
#include "base/printable.hpp"
#include "base/with_remedy.hpp"

namespace mrroc {
namespace {

using Rows = std::array<const FaultEntry*, kFaultNumbers>;

constexpr std::size_t number(FaultCode code) { return static_cast<std::size_t>(code); }

/// @return the framework's own rows by number
constexpr Rows own_rows() {
  Rows rows{};
  for (const FaultEntry& entry : kFaultTable) rows[number(entry.code)] = &entry;
  return rows;
}
constexpr bool rows_are_in_order() {
  return std::ranges::adjacent_find(kFaultTable, std::ranges::greater_equal{}, &FaultEntry::code) ==
         kFaultTable.end();
}
static_assert(rows_are_in_order(), "rows stand in the order of their numbers, each number once");
static_assert(number(kFaultTable.back().code) < kFirstTaskFault);

constinit Rows g_rows = own_rows();  // changes before main() begins only

/// Ends the program before it has begun: there is nobody yet to report to.
[[noreturn]] void refuse(const FaultEntry& entry) {
  fmt::print(
      stderr,
      "error: internal_error: the fault {} (number {}) is registered twice, or its number is too large\n",
      entry.name, number(entry.code));
  std::abort();
}

static_assert(std::is_trivially_copyable_v<Fault>);

std::string figures(const Fault& fault) {
  if (!std::isfinite(fault.value)) return fmt::format("value {}", fault.value);
  if (fault.value == 0 && fault.limit == 0) return {};
  return fmt::format("value {:.6g}, limit {:.6g}", fault.value, fault.limit);
}

}  // namespace

RegisteredFaults::RegisteredFaults(std::span<const FaultEntry> rows) noexcept {
  for (const FaultEntry& entry : rows) {
    const std::size_t k = number(entry.code);
    if (k >= g_rows.size() || g_rows[k] != nullptr || fault_code(entry.name)) refuse(entry);
    g_rows[k] = &entry;
  }
}

std::vector<FaultEntry> all_faults() {
  std::vector<FaultEntry> all;
  for (const FaultEntry* const entry : g_rows)
    if (entry != nullptr) all.push_back(*entry);
  return all;
}

const FaultEntry& fault_entry(FaultCode code) noexcept {
  const FaultEntry* const entry = number(code) < g_rows.size() ? g_rows[number(code)] : nullptr;
  return entry != nullptr ? *entry : *g_rows[number(FaultCode::internal_error)];
}

std::string_view to_string(FaultCode code) noexcept { return fault_entry(code).name; }

std::string_view to_string(FaultClass fault_class) noexcept {
  switch (fault_class) {
    case FaultClass::non_fatal:
      return "non-fatal";
    case FaultClass::fatal:
      return "fatal";
    case FaultClass::system:
      break;
  }
  return "system";
}

FaultClass class_of(FaultCode code) noexcept { return fault_entry(code).fault_class; }

std::optional<FaultCode> fault_code(std::int64_t number) noexcept {
  if (number < 0 || number >= static_cast<std::int64_t>(g_rows.size()) ||
      g_rows[static_cast<std::size_t>(number)] == nullptr)
    return std::nullopt;
  return static_cast<FaultCode>(number);
}

std::optional<FaultCode> fault_code(std::string_view name) noexcept {
  for (const FaultEntry* const entry : g_rows)
    if (entry != nullptr && entry->name == name) return entry->code;
  return std::nullopt;
}

std::string what_happened(const Fault& fault) {
  std::string result;
  if (!fault.process.empty()) result += without_controls(fault.process.view()) + ": ";
  result += fault_entry(fault.code).text;
  std::string detail = fault.axis >= 0 ? fmt::format("axis {}", fault.axis) : std::string();
  for (const std::string& part : {figures(fault), without_controls(fault.text.view())})
    if (!part.empty()) detail += (detail.empty() ? "" : ", ") + part;
  if (!detail.empty()) result += " (" + detail + ")";
  return result;
}

std::string describe(const Fault& fault) {
  const FaultEntry& entry = fault_entry(fault.code);
  return fmt::format("{} {}: {}", to_string(entry.fault_class), entry.name,
                     with_remedy(what_happened(fault), entry.remedy));
}

std::string error_line(const Fault& fault, std::string_view session) {
  const FaultEntry& entry = fault_entry(fault.code);
  return command_hint(
      fmt::format("error: {}: {}", entry.name, with_remedy(what_happened(fault), entry.remedy)), session);
}

int exit_status(FaultCode code) noexcept {
  if (code == FaultCode::none) return 0;
  const bool input = code >= FaultCode::bad_usage && code <= FaultCode::no_such_session;
  if (input || code == FaultCode::bad_plan) return 2;
  return class_of(code) == FaultClass::system ? 3 : 1;
}

FaultError::FaultError(const Fault& fault) : std::runtime_error(what_happened(fault)), fault_(fault) {}

FaultError::FaultError(FaultCode code, const std::string& what)
    : std::runtime_error(without_controls(what)),
      fault_{.code = code, .process = {}, .text = std::string_view(what)} {}

FaultError::FaultError(FaultCode code, const std::string& what, std::string remedy) : FaultError(code, what) {
  remedy_ = std::move(remedy);
}

std::string_view FaultError::remedy() const noexcept {
  return remedy_.empty() ? fault_entry(fault_.code).remedy : std::string_view(remedy_);
}

std::string FaultError::error_line(std::string_view session) const {
  return command_hint(fmt::format("error: {}: {}", to_string(fault_.code), with_remedy(what(), remedy())),
                      session);
}

}  // namespace mrroc
