// SPDX-License-Identifier: MIT
// Memory for what is read at random places of many megabytes: in pages of 2 MiB where the system
// has them, so that the processor needs not look up a page's address for nearly every access.
#pragma once

#include <memory_resource>

namespace renderer {

/// Blocks of at least a huge page are aligned to one and the system is asked for huge pages; small
/// ones are as of new. Any thread may use it; it lives as long as the program.
std::pmr::memory_resource& huge_pages();

}  // namespace renderer
