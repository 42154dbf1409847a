// SPDX-License-Identifier: MIT
#include "progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace renderer {

namespace {

std::string clock_time(double seconds) {
  const auto s = static_cast<long>(seconds + 0.5);
  char text[32];
  if (s >= 3600)
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  else
    std::snprintf(text, sizeof text, "%ld:%02ld", s / 60, s % 60);
  return text;
}

}  // namespace

ProgressBar::ProgressBar() : is_terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (shown_) std::fputc('\n', stderr);
}

void ProgressBar::show(const Progress& p) {
  constexpr double interval = 0.1;
  if (!is_terminal_ || (p.seconds - last_shown_ < interval && p.fraction < 1)) return;
  last_shown_ = p.seconds;
  constexpr int width = 30;
  const int done = std::clamp(static_cast<int>(p.fraction * width), 0, width);
  const std::string bar = std::string(static_cast<std::size_t>(done), '#') +
                          std::string(static_cast<std::size_t>(width - done), '.');
  const double left = p.fraction > 0 ? p.seconds * (1 - p.fraction) / p.fraction : 0;
  std::fprintf(stderr, "\r[%s] %3.0f %%  %llu samples a pixel  %s left  noise %.2f %%   ",
               bar.c_str(), 100 * p.fraction, static_cast<unsigned long long>(p.samples_per_pixel),
               clock_time(left).c_str(), 100 * p.noise);
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace renderer
