// SPDX-License-Identifier: MIT
#include "needs.hpp"

#include <algorithm>
#include <map>

#include "extent.hpp"
#include "view.hpp"

namespace renderer {

namespace {

using Kind = PolarizingElement::Kind;

/// Comparing all pairs of so many takes a blink.
constexpr std::size_t most_elements = 512;

enum class Effect { none, retards, polarizes };

Effect effect_of(const Bsdf& bsdf) {
  if (!bsdf.polarizes()) return Effect::none;
  return std::visit(
      []<class B>(const B& b) {
        if constexpr (!B::polarizes)
          return Effect::none;
        else if constexpr (std::is_same_v<B, LinearPolarizer>)
          return b.polarizing ? Effect::polarizes : Effect::none;
        else if constexpr (std::is_same_v<B, LinearRetarder>)
          return b.delta == 0 ? Effect::none : Effect::retards;
        else
          return Effect::polarizes;
      },
      bsdf.kind());
}

bool is_zero(const Rgb& color) { return malus::max_channel(color) <= 0; }

/// Nothing is left of light, wherever it meets the surface.
bool is_black(const Bsdf& bsdf) {
  return std::visit(
      []<class B>(const B& b) {
        bool black = true;
        if constexpr (requires { b.specular_reflectance; })
          black = black && is_zero(b.specular_reflectance.highest());
        if constexpr (requires { b.specular_transmittance; })
          black = black && is_zero(b.specular_transmittance.highest());
        if constexpr (requires { b.diffuse_reflectance; })
          black = black && is_zero(b.diffuse_reflectance.highest());
        if constexpr (requires { b.transmittance; }) black = black && is_zero(b.transmittance);
        return black;
      },
      bsdf.kind());
}

/// Dielectrics and sheets; all others are surfaces whose front reflects.
bool scatters_on_both_sides(const Bsdf& bsdf) {
  return bsdf.is_sheet() || std::holds_alternative<Dielectric>(bsdf.kind()) ||
         std::holds_alternative<RoughDielectric>(bsdf.kind());
}

bool is_wholly_masked(const Material& material) {
  const FloatTexture& c = material.coverage;
  // A texture's luminance is no more than its largest channel.
  return c.is_constant() ? c.constant <= 0 : malus::max_channel(c.texture->highest()) <= 0;
}

class Analysis {
 public:
  explicit Analysis(const Scene& scene) : scene_(scene) {}

  Needs run() {
    for (std::uint32_t i = 0; i < scene_.shapes.size(); ++i) add_shape(i);
    for (const Medium& medium : scene_.media) add_medium(medium);
    needs_.is_too_large = elements().size() > most_elements;
    if (needs_.is_too_large) {
      for (PolarizingElement& e : elements()) e.receives = e.matters = true;
    } else {
      find_seen();
      find_exchanges();
      judge();
    }
    return std::move(needs_);
  }

 private:
  std::vector<PolarizingElement>& elements() { return needs_.elements; }

  /// Merging takes light for having arrived where it hasn't, as far off as its radius.
  double merge_radius(float part) const {
    const auto techniques = Techniques::named(scene_.integrator.name);
    return techniques && techniques->merge ? static_cast<double>(part * scene_.geometry.radius())
                                           : 0.0;
  }

  /// How far from it light may have arrived that it is given.
  double slack(const PolarizingElement& e) const {
    if (e.kind == Kind::scattering) return merge_radius(scene_.integrator.initial_media_radius);
    if (e.kind == Kind::extinction || e.bsdf->is_delta()) return 0;
    const double radius = merge_radius(scene_.integrator.initial_radius);
    return radius > 0 && !stands_alone(e.shape, radius) ? radius : 0.0;
  }

  /// Light that arrives so near has arrived at this very element.
  bool stands_alone(std::uint32_t shape, double distance) const {
    const Material& material = scene_.shapes[shape].material;
    if (material.back && material.back != material.front) return false;
    const auto [low, high] = scene_.geometry.bounds(shape);
    for (std::uint32_t i = 0; i < scene_.shapes.size(); ++i) {
      if (i == shape) continue;
      const auto [other_low, other_high] = scene_.geometry.bounds(i);
      const Vec3 gap = glm::max(glm::max(other_low - high, low - other_high), Vec3(0.0f));
      // Boxes are as exact as single precision, which a thousandth is far beyond.
      if (static_cast<double>(glm::length(gap)) < 1.001 * distance) return false;
    }
    return true;
  }

  void add_shape(std::uint32_t shape) {
    const Material& material = scene_.shapes[shape].material;
    add_surface(shape, *material.front,
                {true, material.back == material.front ||
                           (!material.back && scatters_on_both_sides(*material.front))});
    if (material.back && material.back != material.front)
      add_surface(shape, *material.back, {false, true});
  }

  void add_surface(std::uint32_t shape, const Bsdf& bsdf, Sides sides) {
    const Effect effect = effect_of(bsdf);
    if (effect == Effect::none) return;
    const Material& material = scene_.shapes[shape].material;
    if (is_wholly_masked(material))
      return needs_.idle.push_back({shape, &bsdf, "is masked wholly"});
    if (is_black(bsdf)) return needs_.idle.push_back({shape, &bsdf, "takes all light"});
    PolarizingElement e;
    e.shape = shape;
    e.bsdf = &bsdf;
    e.only_retards = effect == Effect::retards;
    e.edges = bsdf.is_sheet() && !scene_.integrator.sheets_count ? 0 : 1;
    add(e, extent_of(scene_.geometry, shape, sides, material.is_masked()));
  }

  void add_medium(const Medium& medium) {
    if (!medium.polarizes()) return;
    PolarizingElement e;
    e.medium = &medium;
    if (medium.scatters() && medium.phase().polarizes()) {
      e.kind = Kind::scattering;
      add(e, extent_of_medium(medium));
    }
    if (medium.extinguishes_by_polarization()) {
      e.kind = Kind::extinction;
      e.only_retards = !medium.is_dichroic();
      e.edges = 0;
      add(e, extent_of_medium(medium));
    }
  }

  void add(const PolarizingElement& element, Extent extent) {
    elements().push_back(element);
    slacks_.push_back(slack(element));
    extents_.push_back(std::move(extent));
  }

  /// The bodies that it fills; everywhere, if it is anything else's surroundings.
  Extent extent_of_medium(const Medium& medium) const {
    const Extent everywhere{{}, true};
    const auto is_it = [&](const Medium* m) { return m == &medium; };
    if (is_it(scene_.sensor_medium) ||
        std::any_of(scene_.light_media.begin(), scene_.light_media.end(), is_it))
      return everywhere;
    Extent extent;
    for (std::uint32_t i = 0; i < scene_.shapes.size(); ++i) {
      const Shape& shape = scene_.shapes[i];
      if (!shape.is_boundary) continue;
      if (is_it(shape.exterior)) return everywhere;
      if (!is_it(shape.interior)) continue;
      Extent body = inside_of(scene_.geometry, i);
      if (body.is_everywhere) return everywhere;
      extent.facets.push_back(std::move(body.facets.front()));
    }
    return extent;
  }

  bool fits(int edges) const {
    const int most = scene_.integrator.max_depth;
    return most < 0 || edges <= most;
  }

  void find_seen() {
    const View view(scene_);
    for (std::size_t i = 0; i < elements().size(); ++i) {
      PolarizingElement& e = elements()[i];
      const bool may_be_seen = view.may_see(extents_[i]);
      e.is_seen = may_be_seen && fits(1 + e.edges);
      e.is_cut_off = may_be_seen && !e.is_seen;
    }
  }

  void find_exchanges() {
    const std::size_t n = elements().size();
    partners_.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i; j < n; ++j) {
        PolarizingElement &a = elements()[i], &b = elements()[j];
        const double slack = std::max(slacks_[i], slacks_[j]);
        if (i == j ? !extents_[i].exchanges_with_itself(slack)
                   : !extents_[i].exchanges_with(extents_[j], slack))
          continue;
        // Light, one, the other, and something that turns it to the sensor if that sees neither.
        if (!fits(1 + a.edges + b.edges + (a.is_seen || b.is_seen ? 0 : 1))) {
          a.is_cut_off = b.is_cut_off = true;
          continue;
        }
        partners_[i].push_back(j);
        if (i != j) partners_[j].push_back(i);
      }
    for (std::size_t i = 0; i < n; ++i)
      if (!partners_[i].empty()) elements()[i].partner = static_cast<int>(partners_[i].front());
  }

  void judge() {
    for (std::size_t i = 0; i < elements().size(); ++i) {
      PolarizingElement& e = elements()[i];
      e.receives = std::any_of(partners_[i].begin(), partners_[i].end(),
                               [&](std::size_t j) { return !elements()[j].only_retards; });
      e.matters = !e.only_retards && (e.is_seen || e.receives);
    }
    // Light goes straight through what only retards: what sends it polarised light by it and what
    // reads that behind it see each other without it, too.
    for (std::size_t i = 0; i < elements().size(); ++i)
      if (elements()[i].only_retards)
        elements()[i].matters = std::any_of(
            partners_[i].begin(), partners_[i].end(),
            [&](std::size_t j) { return !elements()[j].only_retards && elements()[j].matters; });
  }

  const Scene& scene_;
  Needs needs_;
  std::vector<Extent> extents_;                     // by element
  std::vector<double> slacks_;                      // by element
  std::vector<std::vector<std::size_t>> partners_;  // by element
};

}  // namespace

std::size_t Needs::count_mattering() const {
  return static_cast<std::size_t>(
      std::count_if(elements.begin(), elements.end(), [](const auto& e) { return e.matters; }));
}

bool Needs::stored_polarization() const {
  return std::any_of(elements.begin(), elements.end(), [](const PolarizingElement& e) {
    const bool is_stored_at =
        e.kind == Kind::scattering || (e.kind == Kind::surface && !e.bsdf->is_delta());
    return e.matters && e.receives && is_stored_at;
  });
}

Needs find_needs(const Scene& scene) { return Analysis(scene).run(); }

void skip_what_is_not_needed(const Needs& needs, Scene& scene) {
  std::map<const Bsdf*, const Bsdf*> made;
  for (const PolarizingElement& e : needs.elements) {
    if (e.matters) continue;
    if (e.kind == Kind::scattering)
      for (Medium& medium : scene.media)
        if (&medium == e.medium) medium.depolarize_what_is_scattered();
    if (e.kind != Kind::surface) continue;
    const Bsdf*& depolarizer = made[e.bsdf];
    if (!depolarizer) depolarizer = &scene.bsdfs.emplace_back(e.bsdf->as_depolarizer());
    Material& material = scene.shapes[e.shape].material;
    for (const Bsdf** side : {&material.front, &material.back})
      if (*side == e.bsdf) *side = depolarizer;
  }
}

}  // namespace renderer
