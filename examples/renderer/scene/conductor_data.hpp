// SPDX-License-Identifier: MIT
// Conductors that scene files give by name.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "../core/vector.hpp"

namespace renderer {

struct ConductorIndex {
  Rgb eta, k;
};

/// The complex index eta + ik of a named conductor, by Mitsuba's names; none if it isn't known.
std::optional<ConductorIndex> conductor_by_name(std::string_view name);

/// All names, for messages: "Ag, Al, ...".
std::string conductor_names();

}  // namespace renderer
