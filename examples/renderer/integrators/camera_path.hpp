// SPDX-License-Identifier: MIT
// A path from the sensor, as an integrator tells of it: where it is scattered and what light is
// deposited there.
#pragma once

#include <type_traits>

#include "remembered_path.hpp"
#include "summed_path.hpp"

namespace renderer {

/// Keep one a thread.
template <class R, class M>
using CameraPath = std::conditional_t<R::defers, RememberedPath<R, M>, SummedPath<R, M>>;

}  // namespace renderer
