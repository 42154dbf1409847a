// SPDX-License-Identifier: MIT
// A line on a terminal that says how far a rendering is. Silent where standard error is no
// terminal.
#pragma once

#include "render.hpp"

namespace renderer {

class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);

 private:
  bool is_terminal_;
  bool shown_ = false;
  double last_shown_ = -1;
};

}  // namespace renderer
