// SPDX-License-Identifier: MIT
// A 4×4 matrix as one writes it without a library, in GLM's layout: columns. The compiler makes
// vector code of its loops; of GLM's products at -march=native it makes code that takes several
// times as long (GCC 12), which would be no fair comparison.
#pragma once

#include <glm/vec4.hpp>

namespace variants {

class NaiveMatrix {
 public:
  NaiveMatrix() = default;
  /// d·I.
  explicit NaiveMatrix(float d) {
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r) column_[c][r] = c == r ? d : 0;
  }
  NaiveMatrix(float a0, float a1, float a2, float a3, float b0, float b1, float b2, float b3,
              float c0, float c1, float c2, float c3, float d0, float d1, float d2, float d3)
      : column_{{a0, a1, a2, a3}, {b0, b1, b2, b3}, {c0, c1, c2, c3}, {d0, d1, d2, d3}} {}

  float* operator[](int c) { return column_[c]; }
  const float* operator[](int c) const { return column_[c]; }

  friend NaiveMatrix operator*(const NaiveMatrix& a, const NaiveMatrix& b) {
    NaiveMatrix result(0.0f);
    for (int c = 0; c < 4; ++c)
      for (int k = 0; k < 4; ++k)
        for (int r = 0; r < 4; ++r) result.column_[c][r] += a.column_[k][r] * b.column_[c][k];
    return result;
  }
  friend glm::vec4 operator*(const NaiveMatrix& a, const glm::vec4& v) {
    float result[4] = {};
    for (int k = 0; k < 4; ++k)
      for (int r = 0; r < 4; ++r) result[r] += a.column_[k][r] * v[k];
    return {result[0], result[1], result[2], result[3]};
  }
  friend NaiveMatrix operator*(NaiveMatrix a, float k) {
    for (auto& column : a.column_)
      for (float& x : column) x *= k;
    return a;
  }
  friend NaiveMatrix operator+(NaiveMatrix a, const NaiveMatrix& b) {
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r) a.column_[c][r] += b.column_[c][r];
    return a;
  }

 private:
  float column_[4][4];
};

}  // namespace variants
