// A task's program as a user starts it, seen from outside: its lines, its children, its end.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace mrroc::test {

/// A folder of its own for a test, removed at the end.
class Folder {
 public:
  /// @param recomputed  whether every run in it is recomputed from its log at the end, and nothing may differ
  explicit Folder(bool recomputed = true);
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Writes a file there. @return its name
  std::string write(const std::string& name, const std::string& content) const;

 private:
  std::filesystem::path path_;
  bool recomputed_;
};

/// One process, told from a later one with the same number.
struct ProcessId {
  pid_t pid{};
  unsigned long long start{};  ///< [clock ticks since boot]
  std::string command;         ///< command line, words separated by spaces

  [[nodiscard]] bool runs() const;
};

/// How a program ended.
struct Ended {
  int status{};  ///< exit status, or 128 + signal
  std::vector<std::string> out, err;

  [[nodiscard]] std::string last_out() const { return out.empty() ? "" : out.back(); }
  [[nodiscard]] std::string last_err() const { return err.empty() ? "" : err.back(); }
  [[nodiscard]] std::string all() const;
};

/// A program of bin/ that runs. Its output goes to files in the folder; sessions are looked for there too, so
/// that it is alone.
class Started {
 public:
  /// @param program  e.g. "drawing", or a path of its own @param name  of this run: of its output files
  Started(const Folder& folder, const std::string& program, const std::vector<std::string>& arguments,
          const std::string& name = "task");
  ~Started();
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;

  /// Waits until a line of the standard output contains the text.
  /// @return false when the program ended before, or so much time passed that it hangs
  bool await_line(const std::string& text);
  [[nodiscard]] pid_t pid() const { return pid_; }
  /// @return its direct children that run
  [[nodiscard]] std::vector<ProcessId> children() const;
  /// @return the only child whose command line names that part of the system, e.g. edp-arm1
  [[nodiscard]] ProcessId child(const std::string& part) const;
  void signal(int number) const;
  /// Waits for the end; a program that does not end is killed and gives status 137.
  Ended end();

 private:
  bool reap(bool wait_for_it);

  std::filesystem::path out_, err_;
  pid_t pid_{};
  bool ended_{};
  int status_{};
};

/// @return the file of a program of bin/
std::filesystem::path started_program(const std::string& program);

/// Runs a program to its end.
Ended run(const Folder& folder, const std::string& program, const std::vector<std::string>& arguments);

/// @return true as soon as none of them runs any more; false after half a minute
bool all_gone(const std::vector<ProcessId>& processes);

/// @return summary.json of a run folder
nlohmann::json summary(const std::filesystem::path& folder);
/// @return a figure of a summary; NaN: it has none, or it is no number
double figure(const nlohmann::json& summary, const std::string& key);

/// @return whether separate processes can talk here
bool multicast();

/// @return an SVG document of that many parallel lines of 40 mm, 10 mm apart; use it with --size 40
std::string lines_svg(int count);

/// @return the words of all lists, one after the other
std::vector<std::string> words(std::initializer_list<std::vector<std::string>> lists);

#ifdef MRROC_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace mrroc::test
