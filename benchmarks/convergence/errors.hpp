// SPDX-License-Identifier: MIT
// The error of a picture, without the noise of what it is compared with.
//
// The truth is known by two independent estimates A and B alone, each the mean of K batches. The
// mean over pixels of (X − A)(X − B) has no noise of theirs in it: its expectation is X's own mean
// squared error, whatever the variances of A and B, if one of them is unbiased or X is. How far
// such a mean may be off because of A and B is known by what it would be with each batch alone, in
// whose values it is linear.
//
// Relative errors weigh a pixel's channel by 1/(S0² + f²), f being a tenth of the channel's mean
// over the picture; those of S1 to S3 are relative to S0 too, since they pass zero.
//
// The degree of polarisation is no linear function: noise makes light look polarised. It is that of
// the mean of the channels, where S0 is more than the floor. The reference's is taken of
// |(S1, S2, S3)|² less its variance (by batches); the measured picture's as it is, since that is
// what its user sees: the mean of what it has too much is `dop_bias`. The reference's variance, to
// first order, is subtracted from the squared error.
#pragma once

#include <array>
#include <vector>

#include "picture.hpp"

namespace convergence {

/// The first four are Stokes components; then S1, S2 and S3 together, and the degree of
/// polarisation.
inline constexpr std::size_t quantities = 6;
inline constexpr std::size_t polarization = 4, degree = 5;
inline constexpr std::array<const char*, quantities> quantity_names{"S0", "S1",    "S2",
                                                                    "S3", "S1-S3", "DoP"};

using PerQuantity = std::array<double, quantities>;

/// Mean squared errors. They are estimates, and where there is hardly any error they may be below
/// zero.
struct Errors {
  PerQuantity square{};           ///< in the picture's units
  PerQuantity relative_square{};  ///< the same of the degree of polarisation
  PerQuantity uncertainty{};      ///< of the latter, one standard error, because of A and B
  double dop_bias = 0;            ///< the mean of a degree of polarisation less the reference's

  void add(const Errors& e, double weight);
};

/// One of the two estimates.
struct Half {
  std::vector<Picture> batches;
  double weight = 0;  ///< in what is taken for the truth where only one picture can be

  std::uint64_t samples() const;
  double seconds() const;
};

class Reference {
 public:
  /// Of at least two batches each, all of one size.
  Reference(Half a, Half b);

  Errors errors(const Picture& x) const;

  /// The standard error of the weighted mean of both, relative, as root of the mean square over
  /// pixels: measured errors are to stay well above it.
  const PerQuantity& standard_error() const { return standard_error_; }
  /// The mean squared difference of A and B beyond their noise, relative, and its standard error.
  /// Of 0 within a few of these nothing is known to be wrong.
  const PerQuantity& distance() const { return distance_; }
  const PerQuantity& distance_error() const { return distance_error_; }
  const Half& a() const { return a_; }
  const Half& b() const { return b_; }
  /// The means over the picture of S0 and of the degree of polarisation.
  double mean_intensity() const { return mean_intensity_; }
  double mean_degree() const { return mean_degree_; }

 private:
  void average();
  void weigh_halves();
  void weigh_pixels();
  void find_degrees();
  void judge_itself();
  void compare_halves();

  Half a_, b_;
  std::vector<double> mean_a_, mean_b_;          // planes
  std::vector<double> variance_a_, variance_b_;  // of these means
  std::vector<double> weights_;                  // of relative errors: three planes
  std::vector<double> degree_, degree_variance_;
  std::vector<bool> lit_;
  std::size_t pixels_, lit_count_ = 0;
  double mean_intensity_ = 0, mean_degree_ = 0;
  PerQuantity standard_error_{}, distance_{}, distance_error_{};
};

}  // namespace convergence
