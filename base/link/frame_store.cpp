#include "base/link/frame_store.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/fault.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> kMagic{'M', 'R', 'R', 'F', 'R', 'M', 'S', '1'};
constexpr off_t kPage = 4096;
constexpr int kLargest = 4096;  // [pixel]
constexpr int kMostSlots = 64;

struct StoreHead {
  std::array<char, 8> magic{};
  FrameStoreShape shape;
  std::int64_t session_id{};
};

struct SlotHead {
  std::uint64_t sequence{};  // odd: being written
  std::int64_t frame{-1};
  std::int64_t step{};
  double t{};
};

bool legal(const FrameStoreShape& s) {
  const auto within = [](int x, int low, int high) { return x >= low && x <= high; };
  return within(s.width, 1, kLargest) && within(s.height, 1, kLargest) &&
         (s.channels == 1 || s.channels == 3) && within(s.slots, 2, kMostSlots);
}

off_t picture_size(const FrameStoreShape& s) { return static_cast<off_t>(s.width) * s.height * s.channels; }

/// Slots begin on pages: one for the head, then the picture.
off_t slot_size(const FrameStoreShape& s) { return kPage + (picture_size(s) + kPage - 1) / kPage * kPage; }
off_t slot_place(const FrameStoreShape& s, int slot) { return kPage + slot * slot_size(s); }
off_t store_size(const FrameStoreShape& s) { return slot_place(s, s.slots); }

bool read_all(int file, void* into, std::size_t size, off_t place) {
  auto* bytes = static_cast<char*>(into);
  while (size > 0) {
    const ssize_t n = ::pread(file, bytes, size, place);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes += n;
    place += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

bool write_all(int file, const void* from, std::size_t size, off_t place) {
  const auto* bytes = static_cast<const char*>(from);
  while (size > 0) {
    const ssize_t n = ::pwrite(file, bytes, size, place);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes += n;
    place += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

[[noreturn]] void cannot_write(const fs::path& path) {
  throw FaultError(FaultCode::cannot_write,
                   fmt::format("cannot use {}: {}", path.string(), std::strerror(errno)));
}

/// Takes away what writers that are dead have left: a living one holds the lock of its file.
void sweep(const fs::path& directory) {
  const std::string mine = fmt::format("mrroc-frames-{}.", ::geteuid());
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(directory, none)) {
    if (!entry.path().filename().string().starts_with(mine)) continue;
    const FileHandle file(::open(entry.path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW));
    if (file.get() >= 0 && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0) ::unlink(entry.path().c_str());
  }
}

/// Makes the file and locks it. A sweeper that comes between both may have taken it for a dead one's.
FileHandle make_file(const fs::path& path) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    FileHandle file(::open(path.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600));
    if (file.get() < 0 && errno == EEXIST)
      throw FaultError(FaultCode::session_in_use, fmt::format("{} belongs to a running task", path.string()));
    if (file.get() < 0) cannot_write(path);
    struct stat s {};
    if (::flock(file.get(), LOCK_EX | LOCK_NB) == 0 && ::fstat(file.get(), &s) == 0 && s.st_nlink > 0)
      return file;
  }
  throw FaultError(FaultCode::cannot_write, fmt::format("cannot keep {}", path.string()));
}

}  // namespace

FileHandle& FileHandle::operator=(FileHandle&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

FileHandle::~FileHandle() {
  if (file_ >= 0) ::close(file_);
}

fs::path FrameStoreName::path() const {
  return directory / fmt::format("mrroc-frames-{}.{}.{}.{}", ::geteuid(), session, session_id, camera);
}

FrameWriter::FrameWriter(FrameStoreName name, const FrameStoreShape& shape)
    : name_(std::move(name)), shape_(shape) {
  if (!legal(shape))
    throw FaultError(FaultCode::internal_error, "a store for pictures of this size cannot be made");
  sweep(name_.directory);
  const fs::path path = name_.path();
  file_ = make_file(path);
  named_ = true;
  // Memory that is not there is refused here, not by a signal later.
  const int error = ::posix_fallocate(file_.get(), 0, store_size(shape_));
  const StoreHead head{kMagic, shape_, name_.session_id};
  if (error == 0 && write_all(file_.get(), &head, sizeof head, 0)) return;
  if (error != 0) errno = error;
  hide();
  cannot_write(path);
}

FrameWriter::~FrameWriter() { hide(); }

void FrameWriter::hide() {
  if (std::exchange(named_, false)) ::unlink(name_.path().c_str());
}

int FrameWriter::write(std::int64_t frame, std::int64_t step, double t, const ImageView& image) {
  if (image.width != shape_.width || image.height != shape_.height || image.channels != shape_.channels)
    throw FaultError(FaultCode::internal_error, "a picture has another size than its store");
  const int slot = static_cast<int>(written_ % static_cast<std::uint64_t>(shape_.slots));
  const off_t place = slot_place(shape_, slot);
  SlotHead head{2 * written_ + 1, frame, step, t};
  bool good = write_all(file_.get(), &head, sizeof head, place);
  good = good && write_all(file_.get(), image.data, image.size(), place + kPage);
  ++head.sequence;
  good = good && write_all(file_.get(), &head, sizeof head, place);
  if (!good) cannot_write(name_.path());
  ++written_;
  return slot;
}

FrameReader::FrameReader(FileHandle file, const FrameStoreShape& shape)
    : file_(std::move(file)), shape_(shape), scratch_(shape.width, shape.height, shape.channels) {}

std::optional<FrameReader> FrameReader::open(const FrameStoreName& name) {
  return check(FileHandle(::open(name.path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW)), name);
}

std::optional<FrameReader> FrameReader::open_hidden(const FrameStoreName& name, pid_t process) {
  const std::string target = name.path().string() + " (deleted)";
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(fmt::format("/proc/{}/fd", process), none))
    if (fs::read_symlink(entry.path(), none) == target)
      return check(FileHandle(::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC)), name);
  return std::nullopt;
}

std::optional<FrameReader> FrameReader::check(FileHandle file, const FrameStoreName& name) {
  const auto refuse = [&](const char* why) {
    throw FaultError(FaultCode::malformed_message, fmt::format("{}: {}", name.path().string(), why));
  };
  StoreHead head;
  // A store that is being made has no head yet.
  if (file.get() < 0 || !read_all(file.get(), &head, sizeof head, 0) || head.magic == decltype(head.magic){})
    return std::nullopt;
  struct stat s {};
  if (::fstat(file.get(), &s) != 0 || !S_ISREG(s.st_mode) || s.st_uid != ::geteuid())
    refuse("it belongs to somebody else");
  if (head.magic != kMagic) refuse("it is no store of frames of this version");
  if (head.session_id != name.session_id) refuse("it belongs to another session");
  if (!legal(head.shape) || s.st_size != store_size(head.shape)) refuse("its sizes do not agree");
  return FrameReader(std::move(file), head.shape);
}

FrameFate FrameReader::read(int slot, std::int64_t frame, Frame& into) {
  if (slot < 0 || slot >= shape_.slots) return FrameFate::malformed;
  const off_t place = slot_place(shape_, slot);
  SlotHead before;
  SlotHead after;
  if (!read_all(file_.get(), &before, sizeof before, place)) return FrameFate::malformed;
  if (before.sequence % 2 != 0 || before.sequence == 0 || before.frame != frame)
    return FrameFate::overwritten;
  if (!read_all(file_.get(), scratch_.data.data(), scratch_.data.size(), place + kPage))
    return FrameFate::malformed;
  if (!read_all(file_.get(), &after, sizeof after, place)) return FrameFate::malformed;
  if (after.sequence != before.sequence) return FrameFate::overwritten;
  into.frame = before.frame;
  into.step = before.step;
  into.t = before.t;
  std::swap(into.image, scratch_);
  if (scratch_.width != shape_.width || scratch_.height != shape_.height ||
      scratch_.channels != shape_.channels ||
      scratch_.data.size() != static_cast<std::size_t>(picture_size(shape_)))
    scratch_ = Image(shape_.width, shape_.height, shape_.channels);
  return FrameFate::read;
}

}  // namespace mrroc::link
