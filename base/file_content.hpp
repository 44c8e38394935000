// Reads a whole file; empty if it cannot be read.
#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace mrroc {

/// @return the file's content; empty when it cannot be read. Files of people are read by base/text_file.hpp
[[nodiscard]] inline std::string file_content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace mrroc
