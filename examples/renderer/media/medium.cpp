// SPDX-License-Identifier: MIT
#include "medium.hpp"

#include <algorithm>
#include <array>

namespace renderer {

namespace {

/// Lengths are finite, so that a channel without extinction has a transmittance.
constexpr float longest = 1e30f;

Rgb exponential(const Rgb& x) {
  return malus::map_channels([](float c) { return std::exp(c); }, x);
}

/// −ln(1 − u): of the rate 1.
float free_path(Sampler& sampler) { return -std::log1p(-sampler.next_1d()); }

/// Each channel's part of what a path carries; equal parts where it carries nothing.
Rgb shares(const Rgb& throughput) {
  const float sum = throughput[0] + throughput[1] + throughput[2];
  if (!(sum > 0) || !malus::is_finite(throughput)) return Rgb(1.0f / 3);
  return throughput * (1 / sum);
}

/// The channel that a number of [0, 1) chooses by the shares; the number is used up.
std::size_t choose(const Rgb& shares, float u) {
  if (u < shares[0]) return 0;
  return u < shares[0] + shares[1] || !(shares[2] > 0) ? 1 : 2;
}

float sum(const Rgb& a) { return a[0] + a[1] + a[2]; }

}  // namespace

Medium::Medium(Description description)
    : d_(std::move(description)), scattering_(d_.extinction * d_.albedo) {
  scatters_ =
      d_.albedo_grid ? malus::max_channel(d_.extinction) > 0 : malus::max_channel(scattering_) > 0;
  emits_ = malus::max_channel(d_.emission) > 0;
  const Rgb& e = d_.extinction;
  is_grey_ = !d_.polarizing && !d_.density && e[0] == e[1] && e[1] == e[2];
  if (!d_.density) return;
  // Any majorant will do; what only glows needs one too.
  const float largest = malus::max_channel(e);
  majorant_ = (largest > 0 ? largest : 1) * d_.density->maximum();
}

Flight Medium::fly(const Ray& ray, float length, const Rgb& throughput, Sampler& sampler) const {
  length = std::min(length, longest);
  if (d_.density) return track(ray, length, throughput, sampler);
  Flight flight;
  flight.distance = length;
  if (!scatters_) {
    flight.transmittance = expected_transmittance(ray, length);
    if (!d_.polarizing) flight.weight = flight.transmittance;
    return flight;
  }
  if (!is_grey_) return fly_by_rates(ray, length, throughput, sampler);
  const float u = sampler.next_1d();
  const float distance = -std::log1p(-u) / d_.extinction[0];
  flight.is_scattered = distance < length;
  if (flight.is_scattered) {
    flight.distance = distance;
    flight.weight = Rgb(1 / d_.extinction[0]);
    flight.transmittance = Rgb(1 - u);
  } else {
    flight.transmittance = Rgb(std::exp(-d_.extinction[0] * length));
  }
  return flight;
}

/// The mixture of all channels' exponentials; where a channel has two rates, by polarisation, of
/// both.
Flight Medium::fly_by_rates(const Ray& ray, float length, const Rgb& throughput,
                            Sampler& sampler) const {
  std::array<Rgb, 2> rates{d_.extinction, d_.extinction};
  const bool by_polarization = extinguishes_by_polarization();
  if (by_polarization) {
    const auto r = d_.polarizing->rates(-ray.direction);
    rates = {r.slowest, r.fastest};
  }
  const Rgb share = shares(throughput);
  const std::size_t channel = choose(share, sampler.next_1d());
  const std::size_t wave = by_polarization && sampler.next_1d() < 0.5f ? 1 : 0;

  Flight flight;
  const float distance = free_path(sampler) / rates[wave][channel];
  flight.is_scattered = distance < length;
  flight.distance = flight.is_scattered ? distance : length;
  const Rgb slow = exponential(rates[0] * -flight.distance);
  const Rgb fast = by_polarization ? exponential(rates[1] * -flight.distance) : slow;
  const float density = flight.is_scattered
                            ? 0.5f * (sum(share * rates[0] * slow) + sum(share * rates[1] * fast))
                            : 0.5f * (sum(share * slow) + sum(share * fast));
  const float inverse = density > 0 ? 1 / density : 0.0f;
  flight.transmittance = by_polarization ? expected_transmittance(ray, flight.distance) : slow;
  flight.weight = by_polarization ? Rgb(inverse) : slow * inverse;
  return flight;
}

/// Delta tracking (Woodcock et al. 1965) with the channels' weights (Kutz et al. 2017): a collision
/// with the medium, or with what fills it up to the same density everywhere, by their shares in all
/// that the path carries.
Flight Medium::track(const Ray& ray, float length, const Rgb& throughput, Sampler& sampler) const {
  Flight flight;
  flight.distance = length;
  flight.transmittance = expected_transmittance(ray, length);
  const Vec2 box = d_.density->clip(ray.origin, ray.direction);
  const float end = std::min(box.y, length);
  const Rgb share = shares(throughput);
  Rgb weight(1.0f);
  for (float t = std::max(box.x, 0.0f);;) {
    t += free_path(sampler) / majorant_;
    if (!(t < end)) break;
    const Rgb real = extinction(ray.origin + t * ray.direction), null = Rgb(majorant_) - real;
    const float real_part = sum(share * weight * real), null_part = sum(share * weight * null);
    if (!(real_part + null_part > 0)) break;
    const float chance = real_part / (real_part + null_part);
    if (sampler.next_1d() < chance) {
      flight.is_scattered = true;
      flight.distance = t;
      flight.weight = weight * (1 / (majorant_ * chance));
      flight.transmittance = expected_transmittance(ray, t);
      return flight;
    }
    weight *= null * (1 / (majorant_ * (1 - chance)));
  }
  flight.weight = weight;
  return flight;
}

/// Ratio tracking (Novák et al. 2014): what a path that is never stopped is left with, and what it
/// has met of the medium's own light on its way.
Rgb Medium::track_transmittance(const Ray& ray, float length, Sampler& sampler,
                                Rgb* emitted) const {
  const Vec2 box = d_.density->clip(ray.origin, ray.direction);
  const float end = std::min(box.y, length);
  Rgb left(1.0f);
  for (float t = std::max(box.x, 0.0f); malus::max_channel(left) > 0;) {
    t += free_path(sampler) / majorant_;
    if (!(t < end)) break;
    const Rgb density = (*d_.density)(ray.origin + t * ray.direction);
    if (emitted) *emitted += left * d_.emission * density * (1 / majorant_);
    left *= Rgb(1.0f) - d_.extinction * density * (1 / majorant_);
  }
  return left;
}

Rgb Medium::transmittance(const Ray& ray, float length, Sampler& sampler) const {
  if (d_.density) return track_transmittance(ray, length, sampler, nullptr);
  return expected_transmittance(ray, length);
}

Rgb Medium::expected_transmittance(const Ray& ray, float length) const {
  length = std::min(length, longest);
  if (d_.density) {
    const Vec2 box = d_.density->clip(ray.origin, ray.direction);
    const float inside = std::max(0.0f, std::min(box.y, length) - std::max(box.x, 0.0f));
    return exponential(d_.extinction * d_.density->mean() * -inside);
  }
  if (is_grey_) return Rgb(std::exp(-d_.extinction[0] * length));
  if (!d_.polarizing) return exponential(d_.extinction * -length);
  return d_.polarizing->unpolarized_transmittance(-ray.direction, length);
}

Rgb Medium::emitted_radiance(const Ray& ray, float length, Sampler& sampler) const {
  length = std::min(length, longest);
  if (d_.density) {
    Rgb result(0.0f);
    track_transmittance(ray, length, sampler, &result);
    return result;
  }
  // ∫ exp(−σ t) dt over the stretch.
  const Rgb stretch = malus::map_channels(
      [length](float s) { return s * length > 1e-4f ? -std::expm1(-s * length) / s : length; },
      d_.extinction);
  return d_.emission * stretch;
}

Medium::Stretch Medium::sample_stretch(const Vec3& direction, float length,
                                       Sampler& sampler) const {
  length = std::min(length, longest);
  const Rgb rates = d_.polarizing->rates(-direction).slowest;
  const float rate = std::min({rates[0], rates[1], rates[2]}), u = sampler.next_1d();
  const float depth = rate * length;
  if (!(depth > 1e-4f)) return {u * length, length};
  const float within = -std::expm1(-depth);
  const float distance = std::min(-std::log1p(-u * within) / rate, length);
  return {distance, within / (rate * std::exp(-rate * distance))};
}

}  // namespace renderer
