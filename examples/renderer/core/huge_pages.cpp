// SPDX-License-Identifier: MIT
#include "huge_pages.hpp"

#include <algorithm>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace renderer {

namespace {

constexpr std::size_t huge_page = std::size_t(1) << 21;

class HugePages : public std::pmr::memory_resource {
  static std::size_t alignment_of(std::size_t bytes, std::size_t alignment) {
    return bytes < huge_page ? alignment : std::max(alignment, huge_page);
  }

  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    void* block = ::operator new(bytes, std::align_val_t(alignment_of(bytes, alignment)));
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    // Whole pages alone: what is behind the block belongs to others. It may be refused.
    if (bytes >= huge_page) ::madvise(block, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
    return block;
  }
  void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override {
    ::operator delete(block, std::align_val_t(alignment_of(bytes, alignment)));
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

}  // namespace

std::pmr::memory_resource& huge_pages() {
  static HugePages resource;
  return resource;
}

}  // namespace renderer
