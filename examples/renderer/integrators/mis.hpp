// SPDX-License-Identifier: MIT
// Recursive multiple importance sampling of vertex connection and merging (Georgiev 2012,
// "Implementing Vertex Connection and Merging"), by the balance heuristic. Densities are those of
// m00: polarisation weighs nothing here.
//
// A subpath carries three partial sums over the techniques that could have made it otherwise; with
// the densities at its end they give the weight of any connection or merge in closed form:
//   vcm  of connecting or merging one vertex back, without that vertex's reverse density;
//   vc   of all connections further back;
//   vm   of all merges further back.
#pragma once

#include "../bsdfs/sample.hpp"

namespace renderer {

/// Which techniques there are, as the sums need them.
struct MisFactors {
  float vm = 0;  ///< η = π r² n_light: merges compared with connections; 0 where nothing is merged
  float vc = 0;  ///< 1/η; 0 where nothing is connected
};

struct SubpathMis {
  float vcm = 0, vc = 0, vm = 0;

  /// The segment to the next vertex turns densities by solid angle there into densities by area.
  void arrive(float distance2, float cosine) {
    vcm *= distance2;
    per_cosine(cosine);
  }
  void per_cosine(float cosine) {
    const float inverse = 1 / cosine;
    vcm *= inverse;
    vc *= inverse;
    vm *= inverse;
  }

  /// The subpath goes on in a sampled direction, at a cosine from the geometric normal. A vertex
  /// with a discrete distribution can be neither connected nor merged.
  void scatter(const BsdfSample& sample, float cosine, const MisFactors& f) {
    if (sample.is_delta) {
      vcm = 0;
      vc *= cosine;
      vm *= cosine;
      return;
    }
    const float out = cosine / sample.pdf;
    vc = out * (vc * sample.reverse_pdf + vcm + f.vm);
    vm = out * (vm * sample.reverse_pdf + vcm * f.vc + 1);
    vcm = 1 / sample.pdf;
  }

  /// The part of a weight's sum that lies beyond a vertex which is connected, given the density of
  /// the direction from there back along the subpath.
  float connected(float reverse_pdf, const MisFactors& f) const {
    return f.vm + vcm + vc * reverse_pdf;
  }
  /// The same of a vertex at which subpaths are merged.
  float merged(float reverse_pdf, const MisFactors& f) const {
    return vcm * f.vc + vm * reverse_pdf;
  }
};

/// The balance heuristic from the sums over the other techniques on both sides.
inline float mis_weight(float light_side, float camera_side) {
  return 1 / (light_side + 1 + camera_side);
}

}  // namespace renderer
