// Common part of all fuzz targets. A target reads any bytes as one of the project's readers does, and fails
// when the reader does, or when what it has read does not keep the reader's contract.
#pragma once
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

/// libFuzzer's, defined by each target. @return 0
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace mrroc::fuzz {

/// A contract is broken; nobody catches it but the test.
struct BrokenContract : std::logic_error {
  using std::logic_error::logic_error;
};

/// @throws BrokenContract unless it holds
inline void require(bool holds, const std::string& contract) {
  if (!holds) throw BrokenContract(contract);
}

/// @return the input as text
inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// An error of a reader names its place, is short, and does not speak to the terminal.
inline void require_readable(std::string_view error) {
  constexpr std::size_t kLongest = 1000;
  require(!error.empty() && error.size() <= kLongest,
          "an error is a line: " + std::string(error.substr(0, 200)));
  for (const char c : error)
    require(static_cast<unsigned char>(c) >= ' ' && c != 0x7f, "an error has no control character");
}

}  // namespace mrroc::fuzz
