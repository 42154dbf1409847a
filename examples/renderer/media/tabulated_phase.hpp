// SPDX-License-Identifier: MIT
// A phase matrix from a table of its six elements at increasing angles (malus/optics/
// scattering_matrix.hpp), per channel. Between the table's angles elements are linear in cos Θ, and
// so is the density that sample() draws by: it is inverted exactly. See isotropic_phase.hpp for
// what a phase kind has.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <malus/optics/scattering_matrix.hpp>
#include <span>
#include <vector>

#include "../core/vector.hpp"
#include "../io/input_error.hpp"

namespace renderer {

class TabulatedPhase {
 public:
  static constexpr bool polarizes = true;

  /// One angle: elements a channel.
  using Row = std::array<malus::ScatteringElements<double>, 3>;

  /// `angles` increase from 0 to π, in radians. Rows need not be normalised. a1 is not negative,
  /// nowhere less than the magnitude of another element, and not 0 everywhere; where it is below a
  /// millionth of its mean it is raised to that, so that everything that can be drawn has a
  /// density. Angles whose cosines single precision can't tell apart are one.
  TabulatedPhase(std::span<const double> angles, std::span<const Row> rows);

  Rgb value(float cosine) const { return value_at(find(cosine)); }

  float pdf(float cosine) const {
    const Place p = find(cosine);
    const float from = knots_[p.cell].density;
    return from + p.part * (knots_[p.cell + 1].density - from);
  }

  float sample(float u) const;

  malus::ScatteringElements<Rgb> elements(float cosine) const {
    const Place p = find(cosine);
    const Others &a = others_[p.cell], &b = others_[p.cell + 1];
    const auto between = [&](Rgb Others::*e) { return a.*e + p.part * (b.*e - a.*e); };
    return {value_at(p),          between(&Others::a2), between(&Others::a3),
            between(&Others::a4), between(&Others::b1), between(&Others::b2)};
  }

 private:
  struct Knot {
    Rgb value;
    float cosine;
    float inverse_width;  ///< to the next
    float density;
  };
  struct Others {
    Rgb a2, a3, a4, b1, b2;
  };
  /// A knot and the part of the way to the next.
  struct Place {
    std::size_t cell;
    float part;
  };
  /// The last knots before buckets of some variable that grows with them: what is in a bucket is in
  /// a cell from this to the next bucket's.
  using Guide = std::vector<std::uint32_t>;

  /// Which bucket a cosine is in: nearly even in the angle, and of one square root.
  std::size_t bucket(float cosine) const {
    const float s = std::sqrt(std::max(1 - std::abs(cosine), 0.0f));
    return static_cast<std::size_t>((cosine < 0 ? 2 - s : s) * buckets_per_unit_);
  }

  /// The last cell of `guide`'s bucket that `begins` before what is looked for.
  template <class F>
  static std::size_t last_cell(const Guide& guide, std::size_t bucket, const F& begins) {
    std::size_t low = guide[bucket], high = guide[bucket + 1];
    // Most buckets hold one knot at most: a sum rather than a branch that none could predict.
    if (high - low <= 1) return low + static_cast<std::size_t>(begins(high) && high > low);
    while (low < high) {
      const std::size_t middle = (low + high + 1) / 2;
      if (begins(middle))
        low = middle;
      else
        high = middle - 1;
    }
    return low;
  }

  Place find(float cosine) const {
    const std::size_t cell = last_cell(guide_, bucket(cosine),
                                       [&](std::size_t i) { return knots_[i].cosine >= cosine; });
    return {cell, (knots_[cell].cosine - cosine) * knots_[cell].inverse_width};
  }

  Rgb value_at(const Place& p) const {
    const Rgb& from = knots_[p.cell].value;
    return from + p.part * (knots_[p.cell + 1].value - from);
  }

  /// Of knots in buckets, in increasing order.
  template <class F>
  Guide make_guide(std::size_t buckets, const F& bucket_of) const;
  void find_cumulative();

  std::vector<Knot> knots_;         // from cos Θ = 1 down
  std::vector<Others> others_;      // of each knot
  std::vector<double> cumulative_;  // the chance of what is before each knot
  Guide guide_, sampling_guide_;
  float buckets_per_unit_ = 0, sampling_buckets_ = 0;
};

/// Reads a table as text: a line for each angle of `angle a1 a2 a3 a4 b1 b2`, blanks or commas
/// between, the angle in degrees, increasing from 0 to 180. Empty lines and what follows a # are
/// passed over. The elements are those of malus/optics/scattering_matrix.hpp in Malus's signs: in
/// frames of the scattering plane with S1 > 0 parallel to it and S3 > 0 right circular in the
/// receiver's view; only their ratios matter. All channels have the same. `asker` is the place that
/// names the file, for the case that it isn't there.
TabulatedPhase read_tabulated_phase(const std::filesystem::path& path, const Location& asker = {});

}  // namespace renderer
