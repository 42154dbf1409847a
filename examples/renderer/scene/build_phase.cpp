// SPDX-License-Identifier: MIT
#include <array>
#include <complex>
#include <memory>

#include "../media/mie_phase.hpp"
#include "build.hpp"
#include "read_for.hpp"
#include "text.hpp"

namespace renderer {

namespace {

PhaseFunction::Kind make_henyey_greenstein(const Object& o) {
  const double g = o.number("g", 0.8);
  const auto rounded = static_cast<float>(g);
  if (!(rounded > -1 && rounded < 1))
    o.fail("g", "the parameter \"g\" is " + shown(g) +
                    "; allowed: above -1, which would be straight back, and below 1, straight on");
  return HenyeyGreensteinPhase(rounded);
}

PhaseFunction::Kind make_rayleigh(const Object& o) {
  // Of a dipole that is as anisotropic as can be.
  constexpr double highest = 6.0 / 7;
  const double depolarization = o.number("depolarization", 0);
  if (!(depolarization >= 0 && depolarization <= highest))
    o.fail("depolarization",
           "the parameter \"depolarization\" is " + shown(depolarization) + "; allowed: 0 to 6/7");
  return RayleighPhase(static_cast<float>(depolarization));
}

/// Not a plugin of Mitsuba's; indices are named as in its BSDFs. Lengths are in micrometres, those
/// of light in vacuum.
PhaseFunction::Kind make_mie(const Object& o) {
  MieParticles particles;
  particles.radius = o.number("radius");
  particles.geometric_deviation = o.number_in("geometric_deviation", 1, 1, 3);
  particles.index = {index_of_refraction(o, "int_ior", "water"),
                     o.number_in("absorption", 0, 0, 1e4)};
  particles.surrounding_index = index_of_refraction(o, "ext_ior", "air");
  std::array<double, 3> wavelengths = rgb_wavelengths;
  if (o.has("wavelengths")) {
    const glm::dvec3 given = o.color_in("wavelengths", glm::dvec3(0), 1e-3, 1e6);
    wavelengths = {given.x, given.y, given.z};
  }
  return std::make_shared<const TabulatedPhase>(
      make_mie_phase(particles, wavelengths, o.location()));
}

PhaseFunction::Kind make_tabulated(const Object& o) {
  const auto path = o.file("filename");
  return std::make_shared<const TabulatedPhase>(
      read_for(o.location(), [&] { return read_tabulated_phase(path, o.location()); }));
}

PhaseFunction::Kind make_kind(const Object& o) {
  if (o.type() == "isotropic") return IsotropicPhase{};
  if (o.type() == "hg") return make_henyey_greenstein(o);
  if (o.type() == "rayleigh") return make_rayleigh(o);
  if (o.type() == "mie") return make_mie(o);
  if (o.type() == "tabulated") return make_tabulated(o);
  fail_unknown_plugin(o, {"hg", "isotropic", "mie", "rayleigh", "tabulated"});
}

}  // namespace

PhaseFunction make_phase(const Object& o) {
  PhaseFunction phase(make_kind(o));
  o.reject_unknown();
  return phase;
}

}  // namespace renderer
