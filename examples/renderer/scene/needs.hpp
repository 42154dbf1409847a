// SPDX-License-Identifier: MIT
// What a scene needs of polarisation, proved before anything is rendered. Light sources are
// unpolarised, and what depolarises reads S0 alone. So the polarisation that an element gives to
// light counts only where that light goes straight on to the sensor or to an element that polarises
// too; and what an element makes of polarised light only where another one sends it some. An
// element for which neither holds is a depolarizer of the same m00, and the picture is the same.
//
// Light that goes straight may pass sheets, masks and boundaries. Elements that send light to each
// other do so both ways, in subpaths from the camera and from lights alike.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene.hpp"

namespace renderer {

/// One side of a shape (or both, where they have one BSDF), or a medium.
struct PolarizingElement {
  enum class Kind { surface, scattering, extinction };
  Kind kind = Kind::surface;
  std::uint32_t shape = 0;
  const Bsdf* bsdf = nullptr;      ///< of a surface
  const Medium* medium = nullptr;  ///< else
  /// Leaves unpolarised light unpolarised, and intensity alone: a retarder.
  bool only_retards = false;
  int edges = 1;  ///< that it adds to a path's length, 0 where it counts for none

  bool is_seen = false;   ///< by the sensor
  int partner = -1;       ///< an element that it exchanges light with, perhaps itself; −1: none
  bool receives = false;  ///< light that may be polarised
  bool matters = false;
  bool is_cut_off = false;  ///< paths that long are not traced by which it might be seen or receive
};

/// Light never meets it, or nothing of it goes on: one of a shape's BSDFs.
struct IdleElement {
  std::uint32_t shape;
  const Bsdf* bsdf;
  std::string reason;
};

struct Needs {
  std::vector<PolarizingElement> elements;
  std::vector<IdleElement> idle;
  /// So many elements that they were not compared: all are taken to exchange light.
  bool is_too_large = false;

  /// Any polarisation counts. Else rendering without it gives the same picture.
  bool polarization() const { return count_mattering() > 0; }
  std::size_t count_mattering() const;
  /// Light that is stored at a vertex, for others to be connected to or merged with, may be
  /// polarised and then count by more than its intensity.
  bool stored_polarization() const;
};

/// For the integrator that the scene has now.
Needs find_needs(const Scene& scene);

/// What doesn't matter becomes a depolarizer, but for media that extinguish by polarisation, whose
/// distances are drawn by it. The scene's integrator must stay what it is.
void skip_what_is_not_needed(const Needs& needs, Scene& scene);

}  // namespace renderer
