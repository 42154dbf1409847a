// SPDX-License-Identifier: MIT
// Media in small scenes, as text.
#pragma once

#include "render_scenes.hpp"

namespace render_test {

inline std::string medium(const std::string& content, const std::string& name = "interior",
                          const std::string& type = "homogeneous") {
  return "<medium type=\"" + type + "\" name=\"" + name + "\">" + content + "</medium>";
}
inline std::string rgb(const std::string& name, const std::string& value) {
  return "<rgb name=\"" + name + "\" value=\"" + value + "\"/>";
}
inline std::string vector(const std::string& name, const std::string& value) {
  return "<vector name=\"" + name + "\" value=\"" + value + "\"/>";
}
inline std::string phase(const std::string& type, const std::string& content = "") {
  return "<phase type=\"" + type + "\">" + content + "</phase>";
}
inline std::string flag(const std::string& name) {
  return "<boolean name=\"" + name + "\" value=\"true\"/>";
}
inline std::string string(const std::string& name, const std::string& value) {
  return "<string name=\"" + name + "\" value=\"" + value + "\"/>";
}
inline std::string sphere(const std::string& content, double radius = 1) {
  return "<shape type=\"sphere\">" + number("radius", radius) + bsdf("null") + content +
         "</shape>\n";
}
inline const std::string camera = meter({0, 0, -9}, {0, 0, 0}, {1, 0, 0});

inline void check_near(const renderer::Rgb& a, const renderer::Rgb& b) {
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(static_cast<double>(a[i]) == doctest::Approx(static_cast<double>(b[i])).epsilon(1e-5));
}

}  // namespace render_test
