// SPDX-License-Identifier: MIT
// Textures. A Texture is a function of a surface's (u, v), made once for a scene, where its address
// stays. What BSDFs hold is a ColorTexture or a FloatTexture: a constant or such a function, cheap
// to copy. A material that holds one that isn't constant makes its shape need the uv.
#pragma once

#include <variant>

#include "../geometry/hit.hpp"
#include "bitmap.hpp"

namespace renderer {

/// Squares of half a unit, one colour where floor(2u) + floor(2v) is even.
struct Checkerboard {
  Rgb even{0.4f}, odd{0.2f};
};

class Texture {
 public:
  using Kind = std::variant<Bitmap, Checkerboard>;

  /// The kind is asked for a(u, v) + offset.
  struct Placement {
    glm::mat2 a{1.0f};
    Vec2 offset{0.0f};
  };

  Texture(Kind kind, const Placement& to_uv);

  Rgb value(const Vec2& uv) const {
    const Vec2 placed = to_uv_.a * uv + to_uv_.offset;
    if (const auto* bitmap = std::get_if<Bitmap>(&kind_)) return bitmap->value(placed);
    return checker(placed);
  }
  /// (∂/∂u, ∂/∂v) of the luminance, 0 where there is a step.
  Vec2 luminance_gradient(const Vec2& uv) const;

  const Kind& kind() const { return kind_; }
  /// Of all texels alike, channel by channel.
  const Rgb& mean() const { return mean_; }
  const Rgb& lowest() const { return lowest_; }
  const Rgb& highest() const { return highest_; }

 private:
  Rgb checker(const Vec2& uv) const;

  Kind kind_;
  Placement to_uv_;
  Rgb mean_{0.0f}, lowest_{0.0f}, highest_{0.0f};
};

/// A colour, the same everywhere or by a texture.
struct ColorTexture {
  Rgb constant{0.0f};  ///< of a texture, its mean
  const Texture* texture = nullptr;

  ColorTexture() = default;
  ColorTexture(const Rgb& color) : constant(color) {}  // NOLINT: any colour is one
  explicit ColorTexture(const Texture& t) : constant(t.mean()), texture(&t) {}

  Rgb operator()(const SurfacePoint& point) const {
    return texture ? texture->value(point.uv) : constant;
  }
  bool is_constant() const { return !texture; }
  const Rgb& mean() const { return constant; }
  const Rgb& lowest() const { return texture ? texture->lowest() : constant; }
  const Rgb& highest() const { return texture ? texture->highest() : constant; }
};

/// A number, the same everywhere or a texture's luminance.
struct FloatTexture {
  float constant = 0;  ///< of a texture, its mean
  const Texture* texture = nullptr;

  FloatTexture() = default;
  FloatTexture(float value) : constant(value) {}  // NOLINT: any number is one
  explicit FloatTexture(const Texture& t) : constant(luminance(t.mean())), texture(&t) {}

  float operator()(const SurfacePoint& point) const {
    return texture ? luminance(texture->value(point.uv)) : constant;
  }
  Vec2 gradient(const SurfacePoint& point) const {
    return texture ? texture->luminance_gradient(point.uv) : Vec2(0.0f);
  }
  bool is_constant() const { return !texture; }
  float mean() const { return constant; }
};

}  // namespace renderer
