// Pictures of a camera on their way from the simulator to the virtual receptors: a ring of slots in shared
// memory, one writer, any number of readers. The message camera_frame_t tells which slot to look at.
//
// Reader and writer copy with read() and write() instead of mapping the memory: a store that is cut short, or changes
// while it is read, is an error that is told, never a crash.
//
// Nothing stays behind: a store has a name only until the system has assembled (hide()), and then lives as long as its
// users. One whose writer was killed before that is recognised by its missing lock, and removed by the next writer.
#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/image.hpp"

namespace mrroc::link {

/// Names one store.
struct FrameStoreName {
  std::string session;                          ///< as in NodeContext
  std::int64_t session_id{};                    ///< likewise
  std::string camera;                           ///< key in the configuration
  std::filesystem::path directory{"/dev/shm"};  ///< of memory that processes of this host share

  /// @return the store's file, also named after the user
  [[nodiscard]] std::filesystem::path path() const;
};

/// One picture and what is known of it.
struct Frame {
  std::int64_t frame{};  ///< 0, 1, 2... of the camera
  std::int64_t step{};   ///< of the effector drivers at which it was taken
  double t{};            ///< simulated time [s]
  Image image;           ///< with the size and channels of the store
};

/// Result of reading a picture.
enum class FrameFate : std::uint8_t {
  read,
  overwritten,  ///< the slot holds another picture by now, or is being written: the reader came too late
  malformed,    ///< no such slot, or the store has been cut short
};

/// An open file, closed at the end.
class FileHandle {
 public:
  /// @param file  descriptor, owned from now on; -1: none
  explicit FileHandle(int file = -1) : file_(file) {}
  FileHandle(FileHandle&& other) noexcept : file_(other.file_) { other.file_ = -1; }
  FileHandle& operator=(FileHandle&& other) noexcept;
  ~FileHandle();
  /// @return descriptor; -1: none
  [[nodiscard]] int get() const { return file_; }

 private:
  int file_;
};

/// Size of the pictures of a store, and how many it holds.
struct FrameStoreShape {
  std::int32_t width{}, height{};  ///< [pixel], 1..4096
  std::int32_t channels{};         ///< 1 or 3
  std::int32_t slots{8};           ///< 2..64
  friend bool operator==(const FrameStoreShape&, const FrameStoreShape&) = default;
};

/// The camera's end. Used by one thread at a time.
class FrameWriter {
 public:
  /// Makes the store; what is left of killed runs in the same directory is removed.
  /// @throws FaultError cannot_write; session_in_use: a living process has a store of this name
  FrameWriter(FrameStoreName name, const FrameStoreShape& shape);
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Removes the name: readers that have opened the store go on reading, others can no longer open it. To be
  /// called when the system has assembled.
  void hide();

  /// @param image  of the store's shape
  /// @return the slot in which it lies @throws FaultError cannot_write
  int write(std::int64_t frame, std::int64_t step, double t, const ImageView& image);

 private:
  FrameStoreName name_;
  FrameStoreShape shape_;
  FileHandle file_;
  bool named_{};
  std::uint64_t written_{};
};

/// A receptor's end. Used by one thread at a time.
class FrameReader {
 public:
  /// Opens a store if it has been made. To be called before the system has assembled.
  /// @throws FaultError malformed_message: it is no store of this version, belongs to another user, or its sizes do not
  ///         agree
  static std::optional<FrameReader> open(const FrameStoreName& name);
  /// Opens a store that has been hidden, through a process that has it open: for a process that comes late and only
  /// looks. @param process  of the same user, e.g. the simulator's
  /// @throws FaultError malformed_message as open()
  static std::optional<FrameReader> open_hidden(const FrameStoreName& name, pid_t process);

  /// @return as the store's header says
  [[nodiscard]] const FrameStoreShape& shape() const { return shape_; }

  /// Copies a picture out.
  /// @param slot  @param frame  what the message told
  /// @param into  untouched unless the fate is `read`
  FrameFate read(int slot, std::int64_t frame, Frame& into);

 private:
  FrameReader(FileHandle file, const FrameStoreShape& shape);
  static std::optional<FrameReader> check(FileHandle file, const FrameStoreName& name);

  FileHandle file_;
  FrameStoreShape shape_;
  Image scratch_;
};

}  // namespace mrroc::link
