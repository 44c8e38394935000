// Text files that people may have edited: read whole, split into lines, errors reported with the line.
#pragma once
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/fault.hpp"

namespace mrroc {

/// A text file (a drawing, recording, trajectory, table of a run) that cannot be used. what() is "FILE:LINE:
/// what is wrong; what to do", without the line where none is known.
class FileError : public std::runtime_error {
 public:
  /// @param file  the name under which the user knows the file
  /// @param line  the line at fault, counted from 1; 0 if unknown
  /// @param wrong  what is wrong
  /// @param remedy  what the user can do about it; may be empty
  FileError(const std::string& file, int line, const std::string& wrong, const std::string& remedy);

  /// @return name under which the user knows it
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] int line() const { return line_; }  ///< counted from 1; 0 if unknown
  /// @return what() without the remedy
  [[nodiscard]] const std::string& wrong() const { return wrong_; }
  [[nodiscard]] const std::string& remedy() const { return remedy_; }  ///< may be empty

 private:
  std::string file_;
  int line_;
  std::string wrong_, remedy_;
};

/// @param limit  largest size accepted [bytes]
/// @return the file's content
/// @throws FileError  missing, a folder, unreadable, empty or too large
[[nodiscard]] std::string read_text_file(const std::filesystem::path& file, std::size_t limit);

/// The same for those who tell errors as faults; an empty file is left to the reader of its text.
/// @param code  of the error
/// @return the file's content
/// @throws FaultError code: missing, no file but a folder, a pipe or a device, unreadable or too large
[[nodiscard]] std::string read_input_file(const std::filesystem::path& file, std::size_t limit,
                                          FaultCode code);

/// Writes a file as a whole: it appears under its name only when it is complete.
/// @throws FaultError cannot_write
void write_text_file(const std::filesystem::path& file, std::string_view content);

/// The lines of a text, each of which has to end with a newline, so that a truncated file is noticed.
class Lines {
 public:
  /// @param text  outlives this object
  /// @param name  the file's name, for errors
  Lines(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {}

  /// @return whether all lines are read
  [[nodiscard]] bool done() const { return rest_.empty(); }
  /// @return the next line without its end @throws FileError at the end of the file or on an unended line
  std::string_view next();
  /// @throws FileError  naming the line that next() returned last
  [[noreturn]] void fail(const std::string& wrong, const std::string& remedy = "") const;

  /// Reads the numbers at the beginning of a line, separated by one character each.
  /// @param line  what next() returned
  /// @param values  receives as many finite numbers as it has room for
  /// @return what stands behind the last number: nothing, or a separator and more fields
  /// @throws FileError  not a finite number, or too few of them
  std::string_view numbers(std::string_view line, char separator, std::span<double> values) const;
  /// @return the whole number, which has to lie between 0 and limit @throws FileError
  [[nodiscard]] std::size_t count(std::string_view text, std::size_t limit) const;

 private:
  std::string_view rest_;
  std::string name_;
  int line_{};
};

}  // namespace mrroc
