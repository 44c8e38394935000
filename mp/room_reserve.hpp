// Reserves room on the disk for what a run must write even when the disk is full.
#pragma once
#include <cstdint>
#include <filesystem>

namespace mrroc::mp {

/// A file of the run folder that is there to be removed: what it took is free for the summary and the black box.
class RoomReserve {
 public:
  /// Size of the reserve [bytes]: a black box has 1 MB an arm, the end of a log 4 MB.
  static constexpr std::uintmax_t kSize = 8'000'000;
  static constexpr const char* kFile = "reserve";  ///< its name

  /// Takes the room. A file system that cannot promise room, and a bound on the size of files, leave it without.
  /// @throws FaultError cannot_write when the disk has no room
  explicit RoomReserve(const std::filesystem::path& folder);
  ~RoomReserve() { release(); }
  RoomReserve(const RoomReserve&) = delete;
  RoomReserve& operator=(const RoomReserve&) = delete;

  /// Gives the room back.
  void release() noexcept;

 private:
  std::filesystem::path file_;
};

}  // namespace mrroc::mp
