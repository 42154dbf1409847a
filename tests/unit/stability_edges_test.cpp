// SPDX-License-Identifier: MIT
// The edges of what is allowed: frames that hardly differ or whose directions disagree, incidence
// to the last place of the cosine, indices next to 1, numbers next to nothing and to everything.
// What is finite and legal gives no NaN, and what is physical stays so. Compiled a second time with
// -ffast-math.
#include <limits>

#include <malus/malus.hpp>

#include "unit/accuracy_support.hpp"

namespace {

using namespace accuracy_test;

template <class T>
using Vector = glm::vec<3, T>;

#define TYPES float, double
template <class T>
constexpr T epsilon = std::numeric_limits<T>::epsilon();

template <class... T>
bool are_finite(const T&... x) {
  return (malus::is_finite(x) && ...);
}
template <class T>
bool is_finite_vector(const Vector<T>& v) {
  return are_finite(v.x, v.y, v.z);
}
template <class M>
bool is_finite_matrix(const M& m) {
  for (int i = 0; i < 16; ++i)
    if (!malus::is_finite(m(i / 4, i % 4))) return false;
  return true;
}
template <class V>
bool are_finite_terms(const malus::FresnelTerms<V>& f) {
  return are_finite(f.s, f.p, f.re, f.im);
}

TEST_CASE_TEMPLATE("stability: directions that disagree by delta cost a rotation delta^2", T,
                   TYPES) {
  Random random(1);
  Exact worst = 0, worst_length = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto d = random.direction();
    const auto base = malus::Frame<double>::about(d).turned(random.between(0, 6));
    const double delta = random.magnitude(1e-7, 1e-3), phi = random.between(-3, 3);
    // Tilted about an axis across, which takes no turn about the direction with it.
    const double where = random.between(0, 6.28);
    const Vector<double> axis = std::cos(where) * base.x() + std::sin(where) * base.y();
    const auto tilt = [&](const Vector<double>& v) {
      return v + std::sin(delta) * glm::cross(axis, v) +
             2 * std::sin(delta / 2) * std::sin(delta / 2) * glm::cross(axis, glm::cross(axis, v));
    };
    const auto turned = base.turned(phi);
    const malus::Frame<T> from(base.x(), base.y()), to(tilt(turned.x()), tilt(turned.y()));
    const auto r = malus::rotation(from, to);
    const Exact off =
        std::max(std::abs(static_cast<Exact>(r.cos2) - std::cos(2 * static_cast<Exact>(phi))),
                 std::abs(static_cast<Exact>(r.sin2) - std::sin(2 * static_cast<Exact>(phi))));
    worst = std::max(worst, off / (delta * delta + 8 * static_cast<double>(epsilon<T>)));
    const Exact length = std::hypot(static_cast<Exact>(r.cos2), static_cast<Exact>(r.sin2));
    worst_length = std::max(worst_length, std::abs(length - 1) / epsilon<T>);
  }
  CHECK(worst <= 1);
  CHECK(worst_length <= 3 * malus::config::error_factor);
}

TEST_CASE_TEMPLATE(
    "stability: any two frames, opposite and degenerate, are a proper rotation apart", T, TYPES) {
#if !MALUS_CHECK_FRAMES
  using malus::Frame;
  const std::array<Vector<T>, 4> axes{Vector<T>(1, 0, 0), Vector<T>(0, 1, 0), Vector<T>(0, 0, 1),
                                      Vector<T>(-1, 0, 0)};
  for (const auto& a : axes)
    for (const auto& b : axes)
      for (const T nudge : {T(0), epsilon<T>, -epsilon<T>, std::numeric_limits<T>::denorm_min()}) {
        const auto from = Frame<T>::about(a), to = Frame<T>::about(b + Vector<T>(nudge, -nudge, 0));
        const auto r = malus::rotation(from, to);
        CHECK(std::abs(std::hypot(static_cast<Exact>(r.cos2), static_cast<Exact>(r.sin2)) - 1) <=
              6 * epsilon<T>);
      }
#endif
  // No length, no angle.
  const malus::Rotation<T> none = malus::rotation_by(T(0), T(0));
  CHECK(none.cos2 == 1);
  CHECK(none.sin2 == 0);
}

TEST_CASE_TEMPLATE("stability: a frame toward a hint that is nearly the direction is a frame", T,
                   TYPES) {
  Random random(2);
  bool finite = true;
  Exact skew = 0, length = 0, nearest = 1;
  for (int i = 0; i < 4000; ++i) {
    const auto d = random.direction();
    const Vector<T> direction(static_cast<T>(d[0]), static_cast<T>(d[1]), static_cast<T>(d[2]));
    const auto o = random.direction();
    const T by = static_cast<T>(random.magnitude(1e-40, 1e-3));
    const T size = static_cast<T>(random.sign() * random.magnitude(1e-37, 1e37));
    const Vector<T> hint = size * (direction + by * Vector<T>(o[0], o[1], o[2]));
    const auto f = malus::Frame<T>::toward(direction, hint);
    finite = finite && is_finite_vector(f.x()) && is_finite_vector(f.y());
    skew = std::max(skew, std::abs(static_cast<Exact>(glm::dot(f.x(), direction))));
    length = std::max(length, std::abs(static_cast<Exact>(glm::length(f.x())) - 1));
    // Where rounding leaves something of the hint, x is on its side, however long it is.
    const Vector<double> wide(d[0], d[1], d[2]), aside(o[0], o[1], o[2]);
    const Vector<double> across = aside - glm::dot(aside, wide) * wide;
    if (by > T(3e-4) && glm::length(across) > 0.1)
      nearest = std::min(
          nearest, static_cast<Exact>((size < 0 ? -1 : 1) *
                                      glm::dot(Vector<double>(f.x()), glm::normalize(across))));
  }
  CHECK(finite);
  CHECK(skew <= 4 * epsilon<T>);
  CHECK(length <= 4 * epsilon<T>);
  CHECK(nearest > 0.99);
  const Vector<T> up(0, 0, 1);
  for (const Vector<T>& hint :
       {Vector<T>(0), up, -up, Vector<T>(std::numeric_limits<T>::denorm_min()),
        Vector<T>(std::numeric_limits<T>::max())}) {
    const auto f = malus::Frame<T>::toward(up, hint);
    CHECK(is_finite_vector(f.x()));
    CHECK(std::abs(glm::length(f.x()) - 1) <= 4 * epsilon<T>);
  }
}

/// A number and its neighbours on both sides, within 0…1.
template <class T>
std::vector<T> around(T x) {
  std::vector<T> list{x};
  T below = x, above = x;
  for (int i = 0; i < 4; ++i) {
    below = std::nextafter(below, T(-1));
    above = std::nextafter(above, T(2));
    if (below >= 0) list.push_back(below);
    if (above <= 1) list.push_back(above);
  }
  return list;
}

TEST_CASE_TEMPLATE(
    "stability: at grazing, normal, Brewster's and critical incidence, to the last place", T,
    TYPES) {
  const T tolerance = 8 * epsilon<T>;
  for (const double wide :
       {1e-9, 1e-4, 0.3, 1 / 1.5, 1 - 1e-7, 1.0, 1 + 1e-7, 1.5, 4.0, 1e4, 1e9}) {
    const T eta = static_cast<T>(wide), least = std::numeric_limits<T>::min();
    const T brewster = 1 / std::sqrt(1 + eta * eta);
    std::vector<T> cosines;
    for (const T centre :
         {T(0), least, T(1e-30), T(1), brewster, std::sqrt(std::max((1 - eta) * (1 + eta), T(0)))})
      for (const T c : around(centre)) cosines.push_back(c);
    for (const T c : cosines) {
      CAPTURE(c);
      CAPTURE(eta);
      const auto f = malus::fresnel_dielectric(c, eta), t = malus::fresnel_transmission(c, eta);
      CHECK(are_finite_terms(f));
      CHECK(are_finite_terms(t));
      CHECK(std::min({f.s, f.p, t.s, t.p}) >= 0);
      CHECK(std::max({f.s, f.p, t.s, t.p}) <= 1 + tolerance);
      // Energy, but for cosθ = 0 where there is no interface, of which nothing is reflected.
      const Exact slope = std::sqrt(epsilon<T>);
      CHECK(std::abs(static_cast<Exact>(f.s) + static_cast<Exact>(t.s) - 1) <= slope);
      CHECK(std::abs(static_cast<Exact>(f.p) + static_cast<Exact>(t.p) - 1) <= slope);
      CHECK(f.re * f.re + f.im * f.im <= f.s * f.p + tolerance);
      const T cosine_t = malus::refracted_cosine(c, eta);
      CHECK(cosine_t >= 0);
      CHECK(cosine_t <= 1 + tolerance);
    }
    if (eta < 1)  // Total reflection is total.
      for (const T c : around(std::sqrt(std::max((1 - eta) * (1 + eta), T(0))) * T(0.99))) {
        CHECK(std::abs(malus::fresnel_dielectric(c, eta).s - 1) <= tolerance);
        CHECK(std::abs(malus::fresnel_dielectric(c, eta).p - 1) <= tolerance);
      }
    // What an ulp of the cosine does there goes by the slope: towards the critical angle by 1/q.
    if (wide > 0.2 && wide < 5)
      for (const T c : around(brewster)) {
        const T q = std::sqrt((eta - 1) * (eta + 1) + c * c),
                amplitude = 40 * epsilon<T> * (1 + 1 / q);
        CHECK(malus::fresnel_dielectric(c, eta).p <= amplitude * amplitude);
      }
  }
  for (const T grazing : {T(1e-30), T(1e-4)}) {
    const auto nothing = malus::fresnel_dielectric(grazing, T(1));
    CHECK(std::max(nothing.s, nothing.p) == 0);
    const auto through = malus::fresnel_transmission(grazing, T(1));
    CHECK(std::abs(std::min(through.s, through.p) - 1) <= tolerance);
  }
}

TEST_CASE_TEMPLATE("stability: a conductor from glass to a perfect mirror reflects between 0 and 1",
                   T, TYPES) {
  const T tolerance = 8 * epsilon<T>;
  for (const double index : {1e-9, 1e-3, 0.05, 1 - 1e-7, 1.0, 1 + 1e-7, 3.0, 1e4})
    for (const double absorbing : {0.0, 1e-30, 1e-7, 1e-3, 1.0, 10.0, 1e4})
      for (const T centre : {T(0), T(1e-30), T(1e-3), T(0.5), T(1)})
        for (const T c : around(centre)) {
          CAPTURE(c);
          CAPTURE(index);
          CAPTURE(absorbing);
          const auto f =
              malus::fresnel_conductor(c, static_cast<T>(index), static_cast<T>(absorbing));
          CHECK(are_finite_terms(f));
          CHECK(std::min(f.s, f.p) >= 0);
          CHECK(std::max(f.s, f.p) <= 1 + tolerance);
          CHECK(f.re * f.re + f.im * f.im <= f.s * f.p + tolerance);
        }
}

TEST_CASE_TEMPLATE("stability: elements and media give no NaN of what is legal", T, TYPES) {
  struct Lab;
  const malus::StaticFrame<Lab> lab;
  const T tiny = std::numeric_limits<T>::denorm_min(), huge = T(1e30), none = 0;
  for (const T a : {none, tiny, T(1e-30), T(1), huge})
    for (const T b : {none, tiny, T(1e-30), T(1), huge}) {
      CHECK(is_finite_matrix(malus::linear_diattenuator(a, b, lab)));
      CHECK(is_finite_matrix(malus::linear_retarder(a, b, lab)));
      CHECK(is_finite_matrix(malus::rotator(a, b, lab)));
      for (const T length : {none, tiny, T(1), huge, std::numeric_limits<T>::infinity()})
        for (const T along : {none, tiny, T(1), huge}) {
          malus::DifferentialMueller<T> k;
          k.extinction = a;
          k.diattenuation = {a / 2, 0, -a / 2};
          k.retardance = {b, along, 0};
          CHECK(is_finite_matrix(malus::transmittance(k, length, lab)));
          CHECK(are_finite(malus::unpolarized_transmittance(k, length)));
          if (sizeof(T) == 4 || std::max(a, b) <= 1)
            CHECK(are_finite(malus::decay_rates(k).slowest, malus::decay_rates(k).fastest));
        }
    }
  for (const T length : {none, T(0.5), 1 - epsilon<T>, T(1), 1 + epsilon<T>})
    CHECK(is_finite_matrix(malus::elliptical_diattenuator(T(1), {length, 0, 0}, lab)));
  for (const T rho : {none, T(1e-30), T(0.5), T(6.0 / 7)})
    for (const T cosine : {T(-1), none, tiny, T(1)}) {
      const auto e = malus::RayleighScattering<T>(rho).elements(cosine);
      CHECK(are_finite(e.a1, e.a2, e.a3, e.a4, e.b1, e.b2));
      CHECK(std::abs(e.b1) <= e.a1 * (1 + 4 * epsilon<T>));
    }
  // Directions that are parallel to rounding, opposite, and just not.
  const Vector<T> d(0, 0, 1);
  for (const T tilt : {none, tiny, T(1e-30), epsilon<T>, std::sqrt(epsilon<T>), T(1e-3)})
    for (const T sign : {T(1), T(-1)}) {
      const Vector<T> o = glm::normalize(Vector<T>(tilt, 0, sign));
      for (const auto& pair :
           {malus::frames_of_scattering<T>(d, o), malus::frames_of_facet<T>(d, o),
            malus::frames_of_incidence<T>(o, d, -d)}) {
        CHECK(is_finite_vector(pair.enter.x()));
        CHECK(is_finite_vector(pair.exit.y()));
        CHECK(glm::length(pair.enter.x()) > 0);
        CHECK(glm::length(pair.exit.y()) > 0);
      }
      malus::UniaxialExtinction<T> medium{.axis = o, .extinction = 1, .linear_dichroism = T(0.5)};
      CHECK(is_finite_vector(medium.frame(d).x()));
      CHECK(is_finite_matrix(medium.transmittance(d, T(1))));
    }
}

TEST_CASE_TEMPLATE("stability: rough surfaces give no NaN, grazing and smooth as they may be", T,
                   TYPES) {
  using malus::MicrofacetShape;
  const T least = std::numeric_limits<T>::min(), none = 0;
  for (const auto shape : {MicrofacetShape::ggx, MicrofacetShape::beckmann})
    for (const T alpha : {T(1e-4), T(1e-3), T(0.3), T(1)}) {
      const malus::MicrofacetDistribution<T> facets(shape, alpha, std::min(2 * alpha, T(1)));
      for (const T z : {least, T(1e-30), T(1e-9), T(1e-4), T(0.5), 1 - epsilon<T>, T(1)})
        for (const T oz : {least, T(1e-9), T(0.5), T(1)})
          for (const T turn : {none, T(1e-4), T(3.14159265)}) {
            const auto at = [](T up, T phi) {
              const T r = std::sqrt((1 - up) * (1 + up));
              return Vector<T>(r * std::cos(phi), r * std::sin(phi), up);
            };
            const Vector<T> v = at(z, 0), w = at(oz, turn);
            CAPTURE(alpha);
            CAPTURE(z);
            CAPTURE(oz);
            CAPTURE(turn);
            CHECK(are_finite(facets.projected_area(v), facets.masking(v), facets.density(w)));
            const auto r = facets.reflection(v, w);
            CHECK(are_finite(r.value, r.pdf_i, r.pdf_o, r.cosine));
            for (const T eta : {T(1), 1 + epsilon<T>, T(1.5), 1 / T(1.5)}) {
              // -ffast-math takes the half vector's length to the eighth power.
              if (malus::config::fast_math && glm::length(eta * v - w) < T(1e-2)) continue;
              const auto t = facets.refraction(v, -w, eta);
              CHECK(are_finite(t.value, t.pdf_i, t.pdf_o, t.cosine));
            }
            for (const T u : {none, T(0.5), 1 - epsilon<T> / 2}) {
              const Vector<T> m = facets.sample_visible(v, u, turn / 4);
              CHECK(is_finite_vector(m));
            }
          }
    }
}

TEST_CASE_TEMPLATE("stability: what light is does not depend on how much there is of it", T,
                   TYPES) {
  struct Lab;
  using Light = malus::Stokes<T, malus::exitant, malus::StaticFrame<Lab>>;
  // Where numbers below the least normal one are flushed to zero, the last digits of small ones
  // are.
  std::vector<double> sizes{malus::config::fast_math ? 1e-30 : 1e-36, 1, 1e30, 3e37};
  if constexpr (sizeof(T) == 8) sizes = {1e-290, 1e-30, 1, 1e300};
  for (const double size : sizes) {
    const T s = static_cast<T>(size);
    CAPTURE(size);
    const Light light(s, T(0.6) * s, 0, T(0.8) * s), more(s, s, s, s);
    CHECK(malus::is_physical(light, 8 * epsilon<T>));
    CHECK_FALSE(malus::is_physical(more, T(0.5)));
    CHECK(std::abs(malus::degree_of_polarization(light) - 1) <= 4 * epsilon<T>);
    CHECK(std::abs(malus::ellipticity(light) - std::atan2(T(0.8), T(0.6)) / 2) <= 4 * epsilon<T>);
    const auto retarder = malus::linear_retarder(s, T(1), malus::StaticFrame<Lab>{});
    CHECK(malus::is_physical(retarder, 16 * epsilon<T>));
    CHECK_FALSE(malus::is_physical(
        malus::FullMueller<T, malus::incident, malus::exitant, malus::StaticFrame<Lab>>::from_rows(
            {{{s, 0, 0, 0}, {0, s, 0, 0}, {0, 0, s, 0}, {0, 0, 0, -s}}}),
        T(1e-3)));
    CHECK(std::abs(malus::coherency_eigenvalues(retarder)[0] / s - 1) <= 16 * epsilon<T>);
  }
}

TEST_CASE_TEMPLATE("stability: NaN and infinity are told, and close to nothing", T, TYPES) {
  struct Lab;
  using Light = malus::Stokes<T, malus::exitant, malus::StaticFrame<Lab>>;
  // By bits: -ffast-math has no such numbers.
  volatile T zero = 0;
  for (const T bad : {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity(),
                      -std::numeric_limits<T>::infinity()}) {
    T value = bad;
    if constexpr (malus::config::keeps_nan) value = bad + zero;
    CHECK_FALSE(malus::is_finite(value));
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<T, 4> s{1, 0, 0, 0};
      s[i] = value;
      const Light light(s[0], s[1], s[2], s[3]);
      CHECK_FALSE(malus::is_physical(light, T(1)));
      CHECK_FALSE(malus::is_close(light, light, T(1)));
    }
  }
  CHECK(malus::is_finite(std::numeric_limits<T>::max()));
  CHECK(malus::is_finite(std::numeric_limits<T>::denorm_min()));
}

}  // namespace
