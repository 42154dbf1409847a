// SPDX-License-Identifier: MIT
// What an integrator's name stands for.
#pragma once

#include <optional>
#include <string_view>

namespace renderer {

/// One technique of bidirectional path tracing: s vertices from the light, t from the camera, the
/// light and the lens being the first of them.
struct Strategy {
  int s, t;
  bool operator==(const Strategy&) const = default;
};

/// The algorithms on subpaths from both ends, as one: what is done with the vertices.
struct Techniques {
  bool connect = false;       ///< vertices with each other, with lights and with the lens, by MIS
  bool merge = false;         ///< camera vertices with the photons near them
  bool first_vertex = false;  ///< at a camera path's first vertex alone, unweighted
  bool lens_alone = false;    ///< no camera paths: light vertices with the lens, unweighted

  static constexpr std::optional<Techniques> named(std::string_view name) {
    if (name == "ptracer") return Techniques{.lens_alone = true};
    if (name == "bdpt") return Techniques{.connect = true};
    if (name == "ppm") return Techniques{.merge = true, .first_vertex = true};
    if (name == "bpm") return Techniques{.merge = true};
    if (name == "vcm") return Techniques{.connect = true, .merge = true};
    return std::nullopt;
  }
};

}  // namespace renderer
