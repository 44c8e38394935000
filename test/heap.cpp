// Every way to the heap leads through malloc and its relatives, which are replaced here for the whole program; a sanitizer,
// whose own they are, tells of each block instead.
#include "test/heap.hpp"

#include <cstddef>

namespace {
thread_local bool counting = false;
thread_local long allocations = 0;
}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): the libraries' own names
#ifdef MRROC_SANITIZED
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*got)(const volatile void*, std::size_t),
                                                         void (*freed)(const volatile void*));
namespace {
[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, std::size_t) { allocations += counting; }, [](const volatile void*) {});
}
#else
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  allocations += counting;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  allocations += counting;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  allocations += counting;
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  allocations += counting;
  return __libc_memalign(alignment, size);
}
}
#endif
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace mrroc::test {

AllocationCounter::AllocationCounter() noexcept {
  allocations = 0;
  counting = true;
}
AllocationCounter::~AllocationCounter() { counting = false; }
long AllocationCounter::count() const noexcept { return allocations; }

}  // namespace mrroc::test
