#include "support/heap_counter.h"

#include <atomic>
#include <cerrno>
#include <cstdlib>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define AQC_TEST_COUNTS_HEAP 1
#else
#define AQC_TEST_COUNTS_HEAP 0
#endif

namespace {

std::atomic<std::size_t> allocations{0};

}  // namespace

#if AQC_TEST_COUNTS_HEAP

// A program's own malloc takes the place of the C library's, everywhere.
extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  ++allocations;
  return __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  ++allocations;
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

}  // extern "C"

#endif

namespace aqc::test {

bool canCountHeap() {
  return AQC_TEST_COUNTS_HEAP != 0;
}

HeapCounter::HeapCounter() : start_(allocations) {}

std::size_t HeapCounter::count() const {
  return allocations - start_;
}

}  // namespace aqc::test
