// SPDX-License-Identifier: MIT
// From a scene file's <texture>, or the plain value in its place, to a texture.
#pragma once

#include <cstdint>
#include <deque>
#include <unordered_map>

#include "../textures/texture.hpp"
#include "object.hpp"

namespace renderer {

class TextureFactory {
 public:
  explicit TextureFactory(std::deque<Texture>& textures) : textures_(textures) {}

  /// The parameter `name`: a plain value or a <texture>, all of which is within the limits.
  ColorTexture color(const Object& object, std::string_view name, double otherwise,
                     double lowest = 0, double highest = 1);
  FloatTexture number(const Object& object, std::string_view name, double otherwise,
                      double lowest = 0, double highest = 1);

  /// Of a <texture>; one for each object, however often it is referred to.
  const Texture& make(const Object::Pointer& object);

  /// How many textures were handed out so far: what asks for one needs (u, v).
  std::size_t handed_out() const { return handed_out_; }
  /// What their pictures take, in bytes.
  std::uint64_t held() const { return held_; }

 private:
  const Texture* nested(const Object& object, std::string_view name, double lowest, double highest);

  std::deque<Texture>& textures_;
  std::unordered_map<const Object*, const Texture*> made_;
  std::size_t handed_out_ = 0;
  std::uint64_t held_ = 0;
};

}  // namespace renderer
