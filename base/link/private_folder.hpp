// A folder and files that other users of the host cannot read or change.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace mrroc::link {

/// Makes a folder that only its user can open, and closes one that is open to others.
/// @throws FaultError cannot_write  it belongs to another user, or is no folder, or cannot be made
void make_private_folder(const std::filesystem::path& folder);

/// Looks, and changes nothing. @return why make_private_folder() would fail when the folders above it have been made; empty:
///         it would not
[[nodiscard]] std::string why_no_private_folder(const std::filesystem::path& folder);

/// @return whether something of that name is there that this user has no power over: another user's, or no folder
[[nodiscard]] bool is_anothers(const std::filesystem::path& folder);

/// Other users' rights on a file that is read.
enum class OwnFile : std::uint8_t {
  trusted,  ///< others may read, not write it
  secret,   ///< nobody
};
/// Reads a small file that belongs to this user.
/// @param why  what is wrong with it, when nothing is returned
/// @return nothing for another user's file, a link, one that others may open, one of more than 64 kB
[[nodiscard]] std::optional<std::string> read_own_file(const std::filesystem::path& path, OwnFile kind,
                                                       std::string& why);

/// Writes a new file that only its user can open.
/// @param why  what went wrong, when false is returned
/// @return false also when something of that name is there, be it a link
[[nodiscard]] bool write_own_file(const std::filesystem::path& path, const std::string& text,
                                  std::string& why);

/// Held while a folder is looked through or changed, by one process at a time.
class FolderLock {
 public:
  /// @param timeout  how long another process may hold it
  /// @throws FaultError cannot_write  it cannot be had; names the process that holds it
  explicit FolderLock(const std::filesystem::path& folder,
                      std::chrono::milliseconds timeout = std::chrono::seconds(5));
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

}  // namespace mrroc::link
