#pragma once

#include <cstddef>

namespace aqc::test {

/// False where the C library's allocator cannot be watched (not glibc, or a sanitizer is in the
/// way).
bool canCountHeap();

/// How often memory was asked for while this object lives: malloc and all that is built on it
/// (operator new, Eigen's aligned blocks, calloc, realloc, aligned_alloc, posix_memalign).
class HeapCounter {
 public:
  HeapCounter();
  std::size_t count() const;

 private:
  std::size_t start_;
};

}  // namespace aqc::test
