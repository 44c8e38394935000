#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <new>
#include <utility>

#include "tasks/rubik/solver/table_file.hpp"

namespace mrroc::rubik {

// Searches read at random places: with large pages, where the system has them, nearly all addresses are found in the
// processor's address cache.

Memory::Memory(std::size_t bytes) : size_(bytes) {
  void* const p = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (p == MAP_FAILED) throw std::bad_alloc();
  base_ = static_cast<std::uint8_t*>(p);
  ::madvise(p, bytes, MADV_HUGEPAGE);
}

Memory Memory::of_file(const std::filesystem::path& file, std::size_t offset) {
  Memory memory;
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return memory;
  struct stat status {};
  if (::fstat(fd, &status) == 0 && static_cast<std::size_t>(status.st_size) > offset) {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const p = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, fd, 0);
    if (p != MAP_FAILED) {
      ::madvise(p, size, MADV_HUGEPAGE);
      memory.base_ = static_cast<std::uint8_t*>(p);
      memory.size_ = size;
      memory.offset_ = offset;
    }
  }
  ::close(fd);
  return memory;
}

Memory::~Memory() {
  if (base_ != nullptr) ::munmap(base_, size_);
}

Memory::Memory(Memory&& other) noexcept
    : base_(std::exchange(other.base_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      offset_(std::exchange(other.offset_, 0)) {}

Memory& Memory::operator=(Memory&& other) noexcept {
  std::swap(base_, other.base_);
  std::swap(size_, other.size_);
  std::swap(offset_, other.offset_);
  return *this;
}

}  // namespace mrroc::rubik
