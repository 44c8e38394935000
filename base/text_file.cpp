#include "base/text_file.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <system_error>

#include "base/fault.hpp"
#include "base/printable.hpp"

namespace mrroc {
namespace fs = std::filesystem;
namespace {

std::string placed(const std::string& file, int line, const std::string& wrong) {
  return without_controls(line > 0 ? fmt::format("{}:{}: {}", file, line, wrong)
                                   : fmt::format("{}: {}", file, wrong));
}

}  // namespace

FileError::FileError(const std::string& file, int line, const std::string& wrong, const std::string& remedy)
    : std::runtime_error(placed(file, line, wrong) + (remedy.empty() ? "" : "; " + remedy)),
      file_(file),
      line_(line),
      wrong_(placed(file, line, wrong)),
      remedy_(remedy) {}

namespace {

/// @throws FileError all that read_text_file() does, but for empty files
std::string whole_file(const fs::path& file, std::size_t limit) {
  const std::string name = file.string();
  std::error_code error;
  if (!fs::exists(file, error)) throw FileError(name, 0, "there is no such file", "check the name");
  // Before it is opened: a process that opens a pipe waits for its other end.
  if (!fs::is_regular_file(file, error))
    throw FileError(name, 0,
                    fs::is_directory(file, error) ? "this is not a file but a folder" : "this is not a file",
                    "check the name");
  const std::uintmax_t size = fs::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  if (error || !in) throw FileError(name, 0, "the file cannot be read", "check its permissions");
  if (size > limit)
    throw FileError(name, 0, fmt::format("{} bytes are over the limit of {}", size, limit),
                    "give a smaller file");
  std::string text(size, '\0');
  in.read(text.data(), static_cast<std::streamsize>(size));
  if (in.gcount() != static_cast<std::streamsize>(size))
    throw FileError(name, 0, "the file could not be read to its end", "try again");
  return text;
}

}  // namespace

std::string read_text_file(const fs::path& file, std::size_t limit) {
  std::string text = whole_file(file, limit);
  if (text.empty()) throw FileError(file.string(), 0, "the file is empty", "give one with content");
  return text;
}

std::string read_input_file(const fs::path& file, std::size_t limit, FaultCode code) try {
  return whole_file(file, limit);
} catch (const FileError& e) {
  throw FaultError(code, e.wrong(), e.remedy());
}

void write_text_file(const fs::path& file, std::string_view content) {
  const fs::path unfinished = file.string() + ".part";
  std::ofstream out(unfinished, std::ios::binary | std::ios::trunc);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  std::error_code error;
  if (out) fs::rename(unfinished, file, error);
  if (!out || error) {
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    throw FaultError(FaultCode::cannot_write, file.string());
  }
}

std::string_view Lines::next() {
  ++line_;
  const std::size_t end = rest_.find('\n');
  if (end == std::string_view::npos) fail("the file ends too early", "it is truncated: make it again");
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end + 1);
  return line;
}

void Lines::fail(const std::string& wrong, const std::string& remedy) const {
  throw FileError(name_, line_, wrong, remedy);
}

std::string_view Lines::numbers(std::string_view line, char separator, std::span<double> values) const {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k > 0) {
      if (line.empty()) fail(fmt::format("{} numbers instead of {}", k, values.size()));
      line.remove_prefix(1);
    }
    const std::string_view field = line.substr(0, line.find(separator));
    const char* const end = field.data() + field.size();
    const auto [stop, error] = std::from_chars(field.data(), end, values[k]);
    if (error != std::errc() || stop != end || !std::isfinite(values[k]))
      fail(fmt::format("'{:.40}' is not a finite number", field));
    line.remove_prefix(field.size());
  }
  return line;
}

std::size_t Lines::count(std::string_view text, std::size_t limit) const {
  std::size_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || value > limit)
    fail(fmt::format("'{:.40}' is not a whole number from 0 to {}", text, limit));
  return value;
}

}  // namespace mrroc
