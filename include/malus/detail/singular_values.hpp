// SPDX-License-Identifier: MIT
// The singular value decomposition of a real 3×3 matrix by one-sided Jacobi rotations (Golub & Van
// Loan, Matrix Computations, section 8.6), which finds small singular values to full precision, and
// the smallest rotation between two axes.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace malus::detail {

/// m vᵀ⁻¹ = (s₀u₀, s₁u₁, s₂u₂), the columns of `scaled`, orthogonal and the longest first; v is a
/// rotation.
template <std::floating_point T>
struct SingularValues {
  glm::mat<3, 3, T> scaled, v;
};

template <std::floating_point T>
SingularValues<T> singular_values(const glm::mat<3, 3, T>& m) {
  glm::mat<3, 3, T> a = m, v(1);
  constexpr int sweeps = 30;
  constexpr std::array<std::pair<int, int>, 3> pairs{{{0, 1}, {0, 2}, {1, 2}}};
  bool turned = true;
  for (int sweep = 0; turned && sweep < sweeps; ++sweep) {
    turned = false;
    for (const auto& [p, q] : pairs) {
      const T pp = glm::dot(a[p], a[p]), qq = glm::dot(a[q], a[q]), pq = glm::dot(a[p], a[q]);
      if (!(std::abs(pq) > std::numeric_limits<T>::epsilon() * std::sqrt(pp) * std::sqrt(qq)))
        continue;
      turned = true;
      const T zeta = (qq - pp) / (2 * pq);
      const T t = std::copysign(T(1), zeta) / (std::abs(zeta) + std::sqrt(zeta * zeta + 1));
      const T c = 1 / std::sqrt(t * t + 1), s = t * c;
      for (glm::mat<3, 3, T>* columns : {&a, &v}) {
        const auto before = (*columns)[p];
        (*columns)[p] = c * before - s * (*columns)[q];
        (*columns)[q] = s * before + c * (*columns)[q];
      }
    }
  }
  // A quarter turn, not a swap, so that v stays a rotation.
  for (const auto& [p, q] : {pairs[0], pairs[1], pairs[2]})
    if (glm::dot(a[q], a[q]) > glm::dot(a[p], a[p]))
      for (glm::mat<3, 3, T>* columns : {&a, &v}) {
        const auto before = (*columns)[p];
        (*columns)[p] = (*columns)[q];
        (*columns)[q] = -before;
      }
  return {a, v};
}

/// The rotation by the smallest angle that takes the unit vector a to the unit vector b.
template <std::floating_point T>
glm::mat<3, 3, T> smallest_rotation(const glm::vec<3, T>& a, const glm::vec<3, T>& b) {
  using Matrix = glm::mat<3, 3, T>;
  const T c = glm::dot(a, b);
  if (c < T(-0.5)) {
    // Near opposite axes: first half a turn about an axis across a, then what is left.
    const glm::vec<3, T> w = glm::cross(a, b);
    const glm::vec<3, T> any =
        std::abs(a.x) < T(0.6) ? glm::vec<3, T>(1, 0, 0) : glm::vec<3, T>(0, 1, 0);
    const T w2 = glm::dot(w, w);
    const glm::vec<3, T> axis = w2 > std::numeric_limits<T>::epsilon()
                                    ? w / std::sqrt(w2)
                                    : glm::normalize(glm::cross(a, any));
    return smallest_rotation(-a, b) * (T(2) * glm::outerProduct(axis, axis) - Matrix(1));
  }
  const glm::vec<3, T> w = glm::cross(a, b);
  const Matrix cross_w(0, w.z, -w.y, -w.z, 0, w.x, w.y, -w.x, 0);
  return c * Matrix(1) + cross_w + glm::outerProduct(w, w) / (1 + c);
}

}  // namespace malus::detail
