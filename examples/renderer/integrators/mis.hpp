// SPDX-License-Identifier: MIT
// Recursive multiple importance sampling of vertex connection and merging (Georgiev 2012,
// "Implementing Vertex Connection and Merging"), by the balance heuristic. Densities are those of
// m00: polarisation weighs nothing here.
//
// A subpath carries two partial sums over the techniques that could have made it otherwise; with
// the densities at its end they give the weight of any connection or merge in closed form:
//   vcm  of connecting or merging one vertex back, without that vertex's reverse density;
//   vc   of all connections and merges further back, relative to connecting at its end.
// Georgiev's third, relative to merging at its end, is the second over η there; η is not the same
// on surfaces and in media.
#pragma once

#include <algorithm>

#include "../bsdfs/sample.hpp"

namespace renderer {

/// Which techniques there are, as the sums need them.
struct MisFactors {
  float connection = 0;     ///< 1, or 0 where nothing is connected
  float surface_merge = 0;  ///< η = π r² n_light: merges compared with connections; 0 without
  float media_merge = 0;    ///< η = 4/3 π r³ n_light

  float merge(bool in_medium) const { return in_medium ? media_merge : surface_merge; }
};

struct SubpathMis {
  float vcm = 0, vc = 0;

  /// The way to the next vertex turns densities by solid angle there into densities by area, or by
  /// volume. Both ends have a density of arriving there by this way (Way).
  void arrive(float distance2, float cosine, float arrival, float reverse_arrival) {
    vcm *= distance2;
    arrive(cosine, arrival, reverse_arrival);
  }
  /// From infinity, or where vcm knows of the distance.
  void arrive(float cosine, float arrival, float reverse_arrival) {
    // Finite, so that what a density of 0 multiplies is 0.
    constexpr float most = 1e30f;
    const float inverse = 1 / (cosine * arrival);
    vcm = std::min(vcm * inverse, most);
    vc = std::min(vc * (inverse * reverse_arrival), most);
  }

  /// The subpath goes on in a sampled direction, at a cosine from the geometric normal, from a
  /// vertex where merges have this η. One with a discrete distribution can be neither connected
  /// nor merged.
  void scatter(const BsdfSample& sample, float cosine, const MisFactors& f, float merge) {
    if (sample.is_delta) {
      vcm = 0;
      vc *= cosine;
      return;
    }
    vc = cosine / sample.pdf * (vc * sample.reverse_pdf + f.connection * vcm + merge);
    vcm = 1 / sample.pdf;
  }

  /// The part of a weight's sum that lies beyond a vertex which is connected, given the density of
  /// the direction from there back along the subpath.
  float connected(float reverse_pdf, float merge) const { return merge + vcm + vc * reverse_pdf; }
  /// The same of a vertex at which subpaths are merged.
  float merged(float reverse_pdf, const MisFactors& f, float merge) const {
    return (f.connection * vcm + vc * reverse_pdf) / merge;
  }
};

/// The balance heuristic from the sums over the other techniques on both sides.
inline float mis_weight(float light_side, float camera_side) {
  return 1 / (light_side + 1 + camera_side);
}

}  // namespace renderer
