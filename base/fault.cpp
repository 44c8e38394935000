#include "base/fault.hpp"

#include <fmt/core.h>

#include <cmath>
#include <type_traits>

#include "base/as_typed.hpp"
#include "base/fault_table.hpp"

namespace mrroc {
namespace {

constexpr bool rows_are_numbered() {
  for (std::size_t k = 0; k < kFaultTable.size(); ++k)
    if (static_cast<std::size_t>(kFaultTable[k].code) != k) return false;
  return true;
}
static_assert(rows_are_numbered(), "row k of the table must describe the code with the number k");
static_assert(static_cast<std::size_t>(FaultCode::interrupted) + 1 == kFaultTable.size());
static_assert(std::is_trivially_copyable_v<Fault>);

std::string printable(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c < ' ' || c > '~') c = '?';
  return result;
}

std::string figures(const Fault& fault) {
  if (!std::isfinite(fault.value)) return fmt::format("value {}", fault.value);
  if (fault.value == 0 && fault.limit == 0) return {};
  return fmt::format("value {:.6g}, limit {:.6g}", fault.value, fault.limit);
}

}  // namespace

const FaultEntry& fault_entry(FaultCode code) noexcept {
  const auto row = static_cast<std::size_t>(code);
  return kFaultTable[row < kFaultTable.size() ? row : static_cast<std::size_t>(FaultCode::internal_error)];
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
  if (number < 0 || number >= static_cast<std::int64_t>(kFaultTable.size())) return std::nullopt;
  return static_cast<FaultCode>(number);
}

std::optional<FaultCode> fault_code(std::string_view name) noexcept {
  for (const FaultEntry& entry : kFaultTable)
    if (entry.name == name) return entry.code;
  return std::nullopt;
}

std::string what_happened(const Fault& fault) {
  std::string result;
  if (!fault.process.empty()) result += printable(fault.process.view()) + ": ";
  result += fault_entry(fault.code).text;
  std::string detail = fault.axis >= 0 ? fmt::format("axis {}", fault.axis) : std::string();
  for (const std::string& part : {figures(fault), printable(fault.text.view())})
    if (!part.empty()) detail += (detail.empty() ? "" : ", ") + part;
  if (!detail.empty()) result += " (" + detail + ")";
  return result;
}

std::string describe(const Fault& fault) {
  const FaultEntry& entry = fault_entry(fault.code);
  return fmt::format("{} {}: {}; {}", to_string(entry.fault_class), entry.name, what_happened(fault),
                     entry.remedy);
}

std::string error_line(const Fault& fault, std::string_view session) {
  const FaultEntry& entry = fault_entry(fault.code);
  return as_typed(fmt::format("error: {}: {}; {}", entry.name, what_happened(fault), entry.remedy), session);
}

int exit_status(FaultCode code) noexcept {
  if (code == FaultCode::none) return 0;
  if (code >= FaultCode::bad_usage && code <= FaultCode::no_such_session) return 2;
  return class_of(code) == FaultClass::system ? 3 : 1;
}

FaultError::FaultError(const Fault& fault) : std::runtime_error(what_happened(fault)), fault_(fault) {}

FaultError::FaultError(FaultCode code, const std::string& what)
    : std::runtime_error(what), fault_{.code = code, .process = {}, .text = std::string_view(what)} {}

FaultError::FaultError(FaultCode code, const std::string& what, std::string remedy) : FaultError(code, what) {
  remedy_ = std::move(remedy);
}

std::string_view FaultError::remedy() const noexcept {
  return remedy_.empty() ? fault_entry(fault_.code).remedy : std::string_view(remedy_);
}

std::string FaultError::error_line(std::string_view session) const {
  return as_typed(fmt::format("error: {}: {}; {}", to_string(fault_.code), what(), remedy()), session);
}

}  // namespace mrroc
