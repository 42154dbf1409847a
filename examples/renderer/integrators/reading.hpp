// SPDX-License-Identifier: MIT
// The paper's measurement equation (2), for one path: W_e · L.
#pragma once

#include <malus/radiometry.hpp>

#include "../sensors/sensor.hpp"
#include "counters.hpp"

namespace renderer {

/// What a sensor whose importance is `weight` reads of light that arrives along one of its rays.
template <class R>
malus::Measurement<Rgb> read(const Sensor& sensor, const Vec3& ray_direction,
                             const typename R::Light& light, Counters& counters,
                             const Rgb& weight = Rgb(1.0f)) {
  if constexpr (R::defers)
    if (R::is_unpolarized(light))  // the sensor's frame doesn't matter
      return {weight * R::intensity(light), Rgb(0.0f), Rgb(0.0f), Rgb(0.0f)};
  if constexpr (R::polarized)
    return counters.made_light(
        R::measure(R::importance(weight, sensor.frame(ray_direction)), light));
  else
    return R::measure(weight, light);  // whatever the frame
}

}  // namespace renderer
