// SPDX-License-Identifier: MIT
// A medium that emits, as a light: paths may start anywhere in it. Paths from the camera find its
// light on their way through it; only where light paths or photons have to bring all light do any
// start there.
#pragma once

#include "../media/medium.hpp"
#include "emitter.hpp"

namespace renderer {

/// Within the box of the shapes that enclose it; a point there may be outside of it yet.
struct Glow {
  const Medium* medium;
  Vec3 low, high;

  /// Uniform in the box, of three numbers in [0, 1).
  Vec3 point(const Vec3& u) const { return low + u * (high - low); }
  float volume() const {
    const Vec3 size = high - low;
    return size.x * size.y * size.z;
  }
};

}  // namespace renderer
