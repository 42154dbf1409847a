// SPDX-License-Identifier: MIT
// Memory in huge pages is memory: of the size and alignment asked for, whatever the system grants.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/huge_pages.hpp"

namespace {

bool is_aligned(const void* block, std::size_t alignment) {
  return reinterpret_cast<std::uintptr_t>(block) % alignment == 0;
}

}  // namespace

TEST_CASE("huge pages: blocks are of their own, and aligned as asked or to a page") {
  constexpr std::size_t page = std::size_t(1) << 21;
  auto& memory = renderer::huge_pages();
  for (const std::size_t bytes : {std::size_t(1), page - 1, page, page + 1, 5 * page + 12345})
    for (const std::size_t alignment : {std::size_t(1), std::size_t(64), 2 * page}) {
      CAPTURE(bytes);
      CAPTURE(alignment);
      auto* first = static_cast<unsigned char*>(memory.allocate(bytes, alignment));
      auto* second = static_cast<unsigned char*>(memory.allocate(bytes, alignment));
      CHECK(is_aligned(first, bytes < page ? alignment : std::max(alignment, page)));
      first[0] = first[bytes - 1] = 1;
      second[0] = second[bytes - 1] = 2;
      CHECK(first[bytes - 1] == 1);
      memory.deallocate(first, bytes, alignment);
      CHECK(second[bytes - 1] == 2);
      memory.deallocate(second, bytes, alignment);
    }
}

TEST_CASE("huge pages: an array keeps what it holds while it grows") {
  std::pmr::vector<std::uint64_t> numbers(&renderer::huge_pages());
  constexpr std::uint64_t count = 700'000;
  for (std::uint64_t i = 0; i < count; ++i) numbers.push_back(i);
  CHECK(std::accumulate(numbers.begin(), numbers.end(), std::uint64_t(0)) ==
        count * (count - 1) / 2);
}
