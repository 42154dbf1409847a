// SPDX-License-Identifier: MIT
// Table 1 of the paper: iterations in 30 minutes at 256 × 256 pixels.
#pragma once

#include <string_view>

namespace variants {

struct PaperRow {
  const char *scene, *algorithm;  ///< as they are called here
  const char* label;              ///< the paper's name of the algorithm
  int nonpol, naive, opti;
};

inline constexpr PaperRow table_1[] = {
    {"diffuse", "path", "PT", 14001, 9129, 12425},
    {"glossy", "path", "PT", 18263, 13728, 15074},
    {"glossy", "vcm", "VCM", 5839, 4533, 4859},
    {"glass", "path", "PT", 15665, 10642, 13638},
    {"glass", "vcm", "VCM", 5540, 3388, 4732},
    {"glass_medium", "path", "VPT", 8401, 2445, 6477},
    {"glass_medium", "bdpt", "VBPT", 4020, 1097, 2589},
    {"bathroom", "vcm", "VCM", 626, 420, 524},
    {"bathroom_medium", "bdpt", "VBPT", 376, 165, 267},
};

constexpr const PaperRow* find_in_table_1(std::string_view scene, std::string_view algorithm) {
  for (const PaperRow& row : table_1)
    if (row.scene == scene && row.algorithm == algorithm) return &row;
  return nullptr;
}

/// The paper's ratio to nonpol; 0 where it has none.
constexpr double paper_ratio(const PaperRow* row, std::string_view variant) {
  if (!row) return 0;
  if (variant == "naive") return static_cast<double>(row->naive) / row->nonpol;
  if (variant == "optimized") return static_cast<double>(row->opti) / row->nonpol;
  return variant == "unpolarized" ? 1 : 0;
}

}  // namespace variants
