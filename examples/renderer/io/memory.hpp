// SPDX-License-Identifier: MIT
// How much memory a machine has. A system may promise memory that it doesn't have, and end the
// program that uses it: what may be large is asked about before.
#pragma once

#include <unistd.h>

#include <cmath>
#include <string>

namespace renderer {

/// In bytes; infinite where the system doesn't tell.
inline double memory_of_machine() {
  const double bytes =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  return bytes > 0 ? bytes : HUGE_VAL;
}

inline bool fits_into_memory(double bytes) { return bytes < 0.8 * memory_of_machine(); }

inline std::string in_gigabytes(double bytes) {
  return std::to_string(static_cast<long long>(bytes / 1e9)) + " GB";
}

/// Of what doesn't fit.
inline std::string allowed_memory() {
  return "; allowed: 4/5 of the " + in_gigabytes(memory_of_machine()) + " that this machine has";
}

}  // namespace renderer
