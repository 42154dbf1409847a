// SPDX-License-Identifier: MIT
#pragma once

namespace renderer {

/// Says that an address will be read soon, so that other work is done while its cache line comes.
/// Any address will do.
inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
#endif
}

/// The same of one that will be written.
inline void prefetch_to_write([[maybe_unused]] const void* address) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address, 1);
#endif
}

}  // namespace renderer
