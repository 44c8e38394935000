#include "test/base/link/no_memory.hpp"

#include <cstdlib>
#include <new>

namespace {
thread_local bool memory_is_out = false;
}  // namespace

// NOLINTBEGIN(cppcoreguidelines-no-malloc): what stands for the allocator itself
void* operator new(std::size_t size) {
  void* const block = memory_is_out ? nullptr : std::malloc(size);
  if (!block) throw std::bad_alloc();
  return block;
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
// NOLINTEND(cppcoreguidelines-no-malloc)

namespace mrroc::link::test {

NoMemory::NoMemory() noexcept { memory_is_out = true; }
NoMemory::~NoMemory() { memory_is_out = false; }

}  // namespace mrroc::link::test
