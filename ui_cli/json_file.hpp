// Reads JSON files of a run folder safely: they may come from anybody.
#pragma once
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "base/fault.hpp"
#include "base/text_file.hpp"

namespace mrroc::ui {

/// @return what is in the file; no object when there is none, when it is no JSON, or over 16 MB. What is nested deeper than
///         32 levels is left out: the library writes and copies by recursion
template <class Json>
[[nodiscard]] Json json_file(const std::filesystem::path& file) {
  constexpr std::size_t kLargest = 16'000'000;
  constexpr int kDeepest = 32;
  std::string text;
  try {
    text = read_input_file(file, kLargest, FaultCode::bad_log);
  } catch (const FaultError&) {
    return {};
  }
  return Json::parse(
      text, [](int depth, typename Json::parse_event_t, Json&) { return depth <= kDeepest; }, false);
}

}  // namespace mrroc::ui
