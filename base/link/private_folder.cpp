#include "base/link/private_folder.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>

#include "base/fault.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr mode_t kOthers = 077;
constexpr mode_t kOthersWrite = 022;
constexpr std::size_t kMostBytes = 65536;

std::string unusable(const fs::path& path, std::string_view why) {
  return fmt::format("cannot use {}: {}", path.string(), why);
}

[[noreturn]] void cannot_use(const fs::path& path, const std::string& why, std::string_view remedy = {}) {
  throw FaultError(FaultCode::cannot_write, unusable(path, why), std::string(remedy));
}

/// @return the process that holds a lock on the file, as the kernel's list tells: "process 12 (press)"
std::string holder_of(int file) {
  struct stat s {};
  if (::fstat(file, &s) != 0) return "another process";
  const std::string wanted = fmt::format("{:02x}:{:02x}:{}", major(s.st_dev), minor(s.st_dev), s.st_ino);
  std::ifstream in("/proc/locks");
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string number, kind, strength, access, pid, where;
    words >> number >> kind >> strength >> access >> pid >> where;
    if (kind != "FLOCK" || where != wanted) continue;
    std::string program;
    std::getline(std::ifstream("/proc/" + pid + "/comm"), program);
    return program.empty() ? "a process that has ended, or one of its children"
                           : fmt::format("process {} ({})", pid, program);
  }
  return "another process";
}

/// @return what is wrong with something that is there; empty: it is this user's folder
std::string_view invalid_reason(const struct stat& s) {
  if (!S_ISDIR(s.st_mode)) return "it is not a directory";
  return s.st_uid != ::geteuid() ? "it belongs to another user" : "";
}

}  // namespace

void make_private_folder(const fs::path& folder) {
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) cannot_use(folder, std::strerror(errno));
  struct stat s {};
  if (::lstat(folder.c_str(), &s) != 0) cannot_use(folder, std::strerror(errno));
  if (const auto why = invalid_reason(s); !why.empty()) cannot_use(folder, std::string(why));
  if ((s.st_mode & kOthers) != 0 && ::chmod(folder.c_str(), 0700) != 0)
    cannot_use(folder, "it is open to other users");
}

std::string why_no_private_folder(const fs::path& folder) {
  struct stat s {};
  if (::lstat(folder.c_str(), &s) == 0) {
    const std::string_view why = invalid_reason(s);
    return why.empty() ? "" : unusable(folder, why);
  }
  fs::path above = folder.parent_path();
  std::error_code ignored;
  while (above.has_relative_path() && !fs::exists(above, ignored)) above = above.parent_path();
  if (fs::is_directory(above, ignored) && ::access(above.c_str(), W_OK | X_OK) == 0) return {};
  return unusable(folder, fmt::format("it cannot be made in {}", above.string()));
}

bool is_anothers(const fs::path& folder) {
  struct stat s {};
  return ::lstat(folder.c_str(), &s) == 0 && (!S_ISDIR(s.st_mode) || s.st_uid != ::geteuid());
}

std::optional<std::string> read_own_file(const fs::path& path, OwnFile kind, std::string& why) {
  // A pipe of that name must not hold anybody up.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) {
    why = std::strerror(errno);
    return std::nullopt;
  }
  struct stat s {};
  std::string text(kMostBytes + 1, '\0');
  ssize_t n = -1;
  if (::fstat(file, &s) != 0 || !S_ISREG(s.st_mode))
    why = "it is no file";
  else if (s.st_uid != ::geteuid())
    why = "it belongs to another user";
  else if ((s.st_mode & (kind == OwnFile::secret ? kOthers : kOthersWrite)) != 0)
    why = "it is open to other users";
  else if ((n = ::read(file, text.data(), text.size())) < 0)
    why = std::strerror(errno);
  else if (static_cast<std::size_t>(n) > kMostBytes)
    why = "it is too large";
  ::close(file);
  if (n < 0 || static_cast<std::size_t>(n) > kMostBytes) return std::nullopt;
  text.resize(static_cast<std::size_t>(n));
  return text;
}

bool write_own_file(const fs::path& path, const std::string& text, std::string& why) {
  const int file = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file < 0) {
    why = std::strerror(errno);
    return false;
  }
  const ssize_t n = ::write(file, text.data(), text.size());
  const bool written = n == static_cast<ssize_t>(text.size());
  if (!written) {
    why = n < 0 ? std::strerror(errno) : "the disk is full";
    ::unlink(path.c_str());  // half a file is none
  }
  ::close(file);
  return written;
}

FolderLock::FolderLock(const fs::path& folder, std::chrono::milliseconds timeout)
    : file_(::open((folder / ".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600)) {
  constexpr std::chrono::milliseconds kLook{10};
  if (file_ < 0) cannot_use(folder / ".lock", std::strerror(errno));
  const auto deadline = Clock::now() + timeout;
  while (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    const int error = errno;
    if (error == EWOULDBLOCK && Clock::now() < deadline) {
      std::this_thread::sleep_for(kLook);
      continue;
    }
    const std::string who = holder_of(file_);
    ::close(file_);
    if (error != EWOULDBLOCK) cannot_use(folder / ".lock", std::strerror(error));
    cannot_use(folder / ".lock",
               fmt::format("{} has held it for {:g} s", who, std::chrono::duration<double>(timeout).count()),
               "end that process");
  }
}

FolderLock::~FolderLock() { ::close(file_); }

}  // namespace mrroc::link
