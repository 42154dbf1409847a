// SPDX-License-Identifier: MIT
// The bounds of docs/accuracy.md, of optical elements, scattering, media, rough surfaces and
// analysis: over random inputs and at the edges of what is allowed, against long double.
#include "unit/accuracy_exact.hpp"

#include <malus/malus.hpp>

namespace {

using namespace accuracy_test;

struct Lab;
using Fixed = malus::StaticFrame<Lab>;
template <class T>
void measure_elements(Bounds& bounds) {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const T t = static_cast<T>(random.magnitude(1e-30, 1)),
            u = static_cast<T>(random.magnitude(1e-30, 1));
    const T phase = static_cast<T>(random.sign() * random.magnitude(1e-20, 1e4));
    const Exact et = t, c = std::cos(static_cast<Exact>(phase)),
                s = std::sin(static_cast<Exact>(phase));
    bounds.compare("linear_polarizer", flat(malus::linear_polarizer(t, Fixed{})),
                   flat({{{1, 1, 0, 0}, {1, 1, 0, 0}, {}, {}}}, et / 2));
    bounds.compare("circular_polarizer",
                   flat(malus::circular_polarizer(t, malus::Handedness::left, Fixed{})),
                   flat({{{1, 0, 0, -1}, {}, {}, {-1, 0, 0, 1}}}, et / 2));
    bounds.compare("depolarizer, attenuator", flat(malus::attenuator(t)),
                   flat({{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}, et));
    bounds.compare("linear_retarder", flat(malus::linear_retarder(t, phase, Fixed{})),
                   flat({{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, c, s}, {0, 0, -s, c}}}, et));
    const auto d = random.direction();
    const std::array<T, 3> fast{static_cast<T>(d[0]), static_cast<T>(d[1]), static_cast<T>(d[2])};
    const Exact a = fast[0], b = fast[1], e = fast[2], v = 1 - c;
    bounds.compare("elliptical_retarder", flat(malus::elliptical_retarder(t, fast, phase, Fixed{})),
                   flat({{{1, 0, 0, 0},
                          {0, c + v * a * a, v * a * b + s * e, v * a * e - s * b},
                          {0, v * a * b - s * e, c + v * b * b, v * b * e + s * a},
                          {0, v * a * e + s * b, v * b * e - s * a, c + v * e * e}}},
                        et));
    const Exact c2 = std::cos(2 * static_cast<Exact>(phase)),
                s2 = std::sin(2 * static_cast<Exact>(phase));
    bounds.compare("rotator", flat(malus::rotator(t, phase, Fixed{})),
                   flat({{{1, 0, 0, 0}, {0, c2, -s2, 0}, {0, s2, c2, 0}, {0, 0, 0, 1}}}, et));
    // Of values as large as numbers come, though no element's are.
    const T x = static_cast<T>(t * static_cast<T>(random.magnitude(1, 1e30)));
    const Exact ex = x, eu = u, mean = std::sqrt(ex) * std::sqrt(eu);
    const Exact sum = (ex + eu) / 2, difference = (ex - eu) / 2;
    bounds.compare("linear_diattenuator", flat(malus::linear_diattenuator(x, u, Fixed{})),
                   flat({{{sum, difference, 0, 0},
                          {difference, sum, 0, 0},
                          {0, 0, mean, 0},
                          {0, 0, 0, mean}}}));
    const double part = 1 - random.magnitude(1e-6, 1);
    const std::array<T, 3> weak{static_cast<T>(part * d[0]), static_cast<T>(part * d[1]),
                                static_cast<T>(part * d[2])};
    const Exact p = weak[0], q = weak[1], r = weak[2], length2 = p * p + q * q + r * r;
    if (length2 < 1) {
      const Exact root = std::sqrt(1 - length2), k = 1 / (1 + root);
      const Rows rows{{{1, p, q, r},
                       {p, root + k * p * p, k * p * q, k * p * r},
                       {q, k * p * q, root + k * q * q, k * q * r},
                       {r, k * p * r, k * q * r, root + k * r * r}}};
      const auto got = flat(malus::elliptical_diattenuator(t, weak, Fixed{}));
      bounds.record<T>("elliptical_diattenuator", are_numbers(got),
                       ulps(got, flat(rows, et), et / root));
    }
  }
}

template <class T>
std::array<T, 6> six(const malus::ScatteringElements<T>& e) {
  return {e.a1, e.a2, e.a3, e.a4, e.b1, e.b2};
}

/// An axis against the exact one: the angle times the sine of the angle between the directions.
template <class T>
double axis_error(const glm::vec<3, T>& got, const std::array<Exact, 3>& exact) {
  const Exact length = std::sqrt(exact[0] * exact[0] + exact[1] * exact[1] + exact[2] * exact[2]);
  const Exact gx = got.x, gy = got.y, gz = got.z, own = std::sqrt(gx * gx + gy * gy + gz * gz);
  const Exact off =
      std::max({std::abs(gx / own - exact[0] / length), std::abs(gy / own - exact[1] / length),
                std::abs(gz / own - exact[2] / length)});
  return static_cast<double>(off * length / last_place<T>(1));
}

template <class T>
void measure_scattering(Bounds& bounds) {
  Random random(12);
  for (int i = 0; i < 4000; ++i) {
    const T m = i == 0 ? T(1) : i == 1 ? T(0) : static_cast<T>(random.between(-1, 1));
    const T rho = static_cast<T>(random.unit() < 0.2 ? 0 : random.magnitude(1e-10, 6.0 / 7));
    const Exact em = m, er = rho, d = (1 - er) / (1 + er / 2), dc = (1 - 2 * er) / (1 + er / 2);
    const malus::RayleighScattering<T> rayleigh(rho);
    const Exact a1 = 0.75L * d * (1 + em * em) + 1 - d, a2 = 0.75L * d * (1 + em * em);
    bounds.compare("RayleighScattering::value", rayleigh.value(m), a1);
    bounds.compare("RayleighScattering::elements", six(rayleigh.elements(m)),
                   {a1, a2, 1.5L * d * em, 1.5L * dc * em, -0.75L * d * (1 - em) * (1 + em), 0});
    const auto value = [&] { return static_cast<T>(random.between(-1, 1)); };
    const T size = static_cast<T>(random.magnitude(1e-12, 1e12));
    const std::complex<T> s1(size * value(), size * value()), s2(size * value(), size * value());
    const Complex e1(s1.real(), s1.imag()), e2(s2.real(), s2.imag()), product = e1 * std::conj(e2);
    const Exact n1 = std::norm(e1), n2 = std::norm(e2), all = (n1 + n2) / 2;
    bounds.compare("scattering_elements", six(malus::scattering_elements(s1, s2)),
                   {all, all, product.real(), product.real(), (n2 - n1) / 2, product.imag()});

    // Two directions at any angle whose sine is not lost in rounding.
    const auto u = random.direction(), w = random.direction();
    const double near = random.unit() < 0.5 ? 1 : random.magnitude(1e-6, 1);
    std::array<double, 3> v{u[0] + near * w[0], u[1] + near * w[1], u[2] + near * w[2]};
    const double norm = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const glm::vec<3, T> in(static_cast<T>(u[0]), static_cast<T>(u[1]), static_cast<T>(u[2]));
    const glm::vec<3, T> out(static_cast<T>(v[0] / norm), static_cast<T>(v[1] / norm),
                             static_cast<T>(v[2] / norm));
    const std::array<Exact, 3> a{in.x, in.y, in.z}, b{out.x, out.y, out.z};
    const std::array<Exact, 3> normal{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                      a[0] * b[1] - a[1] * b[0]};
    const Exact sin2 = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    if (sin2 < 4 * static_cast<Exact>(std::numeric_limits<T>::epsilon())) continue;
    const auto record = [&](const char* name, const glm::vec<3, T>& axis) {
      const double error = axis_error(axis, normal);
      bounds.record<T>(name, is_number(axis.x) && is_number(axis.y) && is_number(axis.z), error);
    };
    record("frames_of_scattering", malus::frames_of_scattering<T>(in, out).exit.y());
    record("frames_of_facet", malus::frames_of_facet<T>(in, out).enter.x());
    record("frames_of_incidence", malus::frames_of_incidence<T>(in, out, out).enter.x());
  }
}

template <class T>
void measure_media(Bounds& bounds) {
  Random random(13);
  for (int i = 0; i < 1500; ++i) {
    malus::DifferentialMueller<T> k;
    const double size = random.magnitude(1e-6, 10);
    const bool block = random.unit() < 0.3;
    Exact most = 0, all = 0;
    for (std::size_t j = 0; j < (block ? 1 : 3); ++j) {
      k.diattenuation[j] = static_cast<T>(size * random.between(-1, 1) / 2);
      k.retardance[j] = static_cast<T>(random.unit() < 0.2 ? 0 : random.between(-4, 4));
      most += std::abs(static_cast<Exact>(k.diattenuation[j]));
      all += std::abs(static_cast<Exact>(k.retardance[j]));
    }
    k.extinction = static_cast<T>(static_cast<double>(most) * random.between(1, 3));
    const T length = static_cast<T>(random.magnitude(1e-6, 4));
    const Exact l = length, e = l * k.extinction, d1 = l * k.diattenuation[0],
                d2 = l * k.diattenuation[1], d3 = l * k.diattenuation[2], r1 = l * k.retardance[0],
                r2 = l * k.retardance[1], r3 = l * k.retardance[2];
    const Rows right = exponential(
        {{{e, -d1, -d2, -d3}, {-d1, e, -r3, r2}, {-d2, r3, e, -r1}, {-d3, -r2, r1, e}}});
    // The exponents are rounded, too.
    const Exact scale = right[0][0] * (1 + e + l * (most + all));
    const auto got = flat(malus::transmittance(k, length, Fixed{}));
    bounds.record<T>("transmittance", are_numbers(got), ulps(got, flat(right), scale));
    const std::array<T, 1> m00{malus::unpolarized_transmittance(k, length)};
    bounds.record<T>("unpolarized_transmittance", are_numbers(m00),
                     ulps(m00, std::array{right[0][0]}, scale));
    // The rates are the eigenvalues: on their sum and on the extinction.
    const auto rates = malus::decay_rates(k);
    Exact u = 0, v = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const Exact d = k.diattenuation[j], r = k.retardance[j];
      u += d * d - r * r, v -= 2 * d * r;
    }
    const Exact spread = std::abs(std::sqrt(Complex(u, v)).real()), mean = k.extinction;
    bounds.compare("decay_rates", std::array{rates.slowest, rates.fastest},
                   {std::max(mean - spread, 0.0L), mean + spread});

    malus::UniaxialExtinction<T> medium;
    const auto a = random.direction(), o = random.direction();
    medium.axis = {static_cast<T>(a[0]), static_cast<T>(a[1]), static_cast<T>(a[2])};
    medium.extinction = k.extinction;
    medium.linear_dichroism =
        static_cast<T>(static_cast<double>(k.extinction) * random.between(0, 1));
    medium.circular_dichroism = static_cast<T>(random.sign() * random.magnitude(1e-25, 1e25));
    medium.linear_birefringence = k.retardance[0];
    const glm::vec<3, T> direction(static_cast<T>(o[0]), static_cast<T>(o[1]),
                                   static_cast<T>(o[2]));
    const Exact ax = medium.axis.x, ay = medium.axis.y, az = medium.axis.z;
    const Exact dx = direction.x, dy = direction.y, dz = direction.z;
    const Exact cx = dy * az - dz * ay, cy = dz * ax - dx * az, cz = dx * ay - dy * ax;
    const Exact sin2 = std::min(cx * cx + cy * cy + cz * cz, 1.0L);
    bounds.compare("UniaxialExtinction::mean_extinction", medium.mean_extinction(direction),
                   mean + static_cast<Exact>(medium.linear_dichroism) * sin2 / 2);
    const auto differential = medium.differential(direction);
    bounds.compare("UniaxialExtinction::differential", differential.retardance[0],
                   -sin2 * static_cast<Exact>(medium.linear_birefringence),
                   medium.linear_birefringence);
    bounds.record<T>("UniaxialExtinction::frame", true,
                     axis_error(medium.frame(direction).x(),
                                {cy * dz - cz * dy, cz * dx - cx * dz, cx * dy - cy * dx}));
    medium.linear_dichroism = -std::abs(medium.circular_dichroism) * static_cast<T>(random.unit());
    const Exact linear = medium.linear_dichroism, circular = medium.circular_dichroism;
    bounds.compare("UniaxialExtinction::least_absorption", medium.least_absorption(),
                   (std::sqrt(linear * linear + circular * circular) - linear) / 2);
  }
}

/// Walter et al.'s equation 21, of radiance, with eta the index on wi's side over that on wo's.
template <class T>
void measure_refraction(Bounds& bounds, const std::string& name,
                        const malus::MicrofacetDistribution<T>& facets, const Facets& right,
                        const glm::vec<3, T>& wi, const glm::vec<3, T>& wo, Random& random) {
  const T eta =
      static_cast<T>(random.unit() < 0.5 ? random.between(1.1, 2.5) : 1 / random.between(1.1, 2.5));
  const Exact e = eta;
  const std::array<Exact, 3> i{wi.x, wi.y, wi.z}, o{wo.x, wo.y, wo.z};
  std::array<Exact, 3> h{e * i[0] + o[0], e * i[1] + o[1], e * i[2] + o[2]};
  if (h[2] < 0) h = {-h[0], -h[1], -h[2]};
  const Exact length = std::sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
  const Exact im = (i[0] * h[0] + i[1] * h[1] + i[2] * h[2]) / length;
  const Exact om = (o[0] * h[0] + o[1] * h[1] + o[2] * h[2]) / length;
  const Exact x = h[0] / h[2] / right.ax, y = h[1] / h[2] / right.ay, slopes = x * x + y * y;
  if (slopes > 50 || im < 1e-3L || om > -1e-3L) return;
  const Exact bend = e * im + om, below[] = {o[0], o[1], -o[2]};
  const Exact value = im * -om * right.density(h) * right.masking(i) *
                      right.masking({below[0], below[1], below[2]}) / (i[2] * -o[2] * bend * bend);
  const std::array<T, 1> got{facets.refraction(wi, wo, eta).value};
  const Exact loss = (1 + slopes) / (h[2] * std::min(right.ax, right.ay)) + 1 / std::min(im, -om);
  bounds.record<T>(name, are_numbers(got), ulps(got, std::array{value}, value * loss));
}

template <class T>
void measure_facets(Bounds& bounds) {
  Random random(14);
  for (int i = 0; i < 4000; ++i) {
    const bool ggx = random.unit() < 0.5;
    const T ax = static_cast<T>(random.magnitude(1e-3, 1)),
            ay = static_cast<T>(random.magnitude(1e-3, 1));
    const malus::MicrofacetDistribution<T> facets(
        ggx ? malus::MicrofacetShape::ggx : malus::MicrofacetShape::beckmann, ax, ay);
    const Facets right{ggx, ax, ay};
    const auto up = [&] {
      auto d = random.direction();
      d[2] = std::abs(d[2]) + 0.02;
      const double n = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      return glm::vec<3, T>(static_cast<T>(d[0] / n), static_cast<T>(d[1] / n),
                            static_cast<T>(d[2] / n));
    };
    const auto exact = [](const glm::vec<3, T>& v) { return std::array<Exact, 3>{v.x, v.y, v.z}; };
    const glm::vec<3, T> v = up(), w = up();
    const std::array<T, 1> area{facets.projected_area(v)}, masked{facets.masking(v)};
    const Exact mask = right.masking(exact(v)), whole = static_cast<Exact>(v.z) / mask;
    const std::string by = ggx ? ", GGX" : ", Beckmann";
    bounds.record<T>("projected_area" + by, are_numbers(area),
                     ulps(area, std::array{whole}, whole));
    bounds.record<T>("masking" + by, are_numbers(masked), ulps(masked, std::array{mask}, mask));

    // A facet within a few roughnesses; errors grow with the exponent and, of half vectors, with
    // what is lost where slopes are small.
    const double reach = 4 * random.unit(), turn = random.between(0, 6.28);
    const glm::vec<3, T> m(static_cast<T>(static_cast<double>(ax) * reach * std::cos(turn)),
                           static_cast<T>(static_cast<double>(ay) * reach * std::sin(turn)), T(1));
    const std::array<T, 1> density{facets.density(m)};
    const Exact d = right.density(exact(m));
    bounds.record<T>("density" + by, are_numbers(density),
                     ulps(density, std::array{d}, d * static_cast<Exact>(1 + reach * reach)));
    const auto drawn =
        facets.sample_visible(v, static_cast<T>(random.unit()), static_cast<T>(random.unit()));
    const Exact length =
        std::sqrt(static_cast<Exact>(drawn.x) * drawn.x + static_cast<Exact>(drawn.y) * drawn.y +
                  static_cast<Exact>(drawn.z) * drawn.z);
    bounds.record<T>("sample_visible, of length 1",
                     is_number(drawn.x) && is_number(drawn.y) && is_number(drawn.z) && drawn.z > 0,
                     static_cast<double>(std::abs(length - 1) / last_place<T>(1)));
    measure_refraction(bounds, "refraction" + by, facets, right, v, -w, random);
    const auto lobe = facets.reflection(v, w);
    const std::array<Exact, 3> ev = exact(v), ew = exact(w);
    const std::array<Exact, 3> h{ev[0] + ew[0], ev[1] + ew[1], ev[2] + ew[2]};
    const Exact slopes =
        (h[0] * h[0] / (right.ax * right.ax) + h[1] * h[1] / (right.ay * right.ay)) / (h[2] * h[2]);
    if (slopes > 50) continue;
    const Exact value = right.density(h) * mask * right.masking(ew) / (4 * ev[2] * ew[2]);
    const std::array<T, 1> got{lobe.value};
    // A half vector is off by a rounding of its parts, over its z and the roughness.
    const Exact loss = (1 + slopes) / (h[2] * std::min(right.ax, right.ay));
    bounds.record<T>("reflection" + by, are_numbers(got),
                     ulps(got, std::array{value}, value * loss));
  }
}

template <class T>
void measure_analysis(Bounds& bounds) {
  Random random(15);
  for (int i = 0; i < 2000; ++i) {
    const double size = random.magnitude(1e-30, 1e30);
    const auto d = random.direction();
    const double degree = random.unit();
    const auto part = [&](double x) { return static_cast<T>(size * x); };
    const malus::Stokes<T, malus::exitant, Fixed> s(part(1), part(degree * d[0]),
                                                    part(degree * d[1]), part(degree * d[2]));
    const Exact s0 = s[0], s1 = s[1], s2 = s[2], s3 = s[3];
    const Exact linear = std::sqrt(s1 * s1 + s2 * s2), all = std::sqrt(linear * linear + s3 * s3);
    bounds.compare("degree_of_polarization", malus::degree_of_polarization(s), all / s0);
    bounds.compare("degree_of_linear_polarization", malus::degree_of_linear_polarization(s),
                   linear / s0);
    bounds.compare("degree_of_circular_polarization", malus::degree_of_circular_polarization(s),
                   s3 / s0);
    Exact angle = std::atan2(s2, s1) / 2;
    if (angle < 0) angle += pi;
    bounds.compare("angle_of_linear_polarization", malus::angle_of_linear_polarization(s), angle,
                   pi);
    bounds.compare("ellipticity", malus::ellipticity(s), std::atan2(s3, linear) / 2);
    const T psi = static_cast<T>(random.between(0, 3)),
            chi = static_cast<T>(random.between(-0.7, 0.7));
    const T p = static_cast<T>(degree);
    const auto ellipse = malus::from_ellipse(part(1), p, psi, chi, Fixed{});
    const Exact polarized = s0 * p, c = std::cos(2 * static_cast<Exact>(chi));
    bounds.compare("from_ellipse", std::array{ellipse[0], ellipse[1], ellipse[2], ellipse[3]},
                   {s0, polarized * c * std::cos(2 * static_cast<Exact>(psi)),
                    polarized * c * std::sin(2 * static_cast<Exact>(psi)),
                    polarized * std::sin(2 * static_cast<Exact>(chi))});
    const malus::Measurement<T> reading(part(0.7), part(0.6 + d[0] / 3), part(0.3),
                                        part(0.5 + d[1] / 3));
    const auto found = malus::from_four_filters(reading, Fixed{});
    const Exact f0 = reading[0], f1 = reading[1], f2 = reading[2], f3 = reading[3];
    bounds.compare("from_four_filters", std::array{found[0], found[1], found[2], found[3]},
                   {f0 + f2, f0 - f2, 2 * f1 - f0 - f2, 2 * f3 - f0 - f2});

    // A physical matrix of known parts, of any size: a depolarizer, a retarder and a diattenuator.
    const T phase = static_cast<T>(random.between(0.01, 3.1)), weight = part(1);
    const std::array<T, 3> fast{static_cast<T>(d[0]), static_cast<T>(d[1]), static_cast<T>(d[2])};
    const double weak = 0.9 * random.unit();
    const auto e = random.direction();
    const std::array<T, 3> dichroic{static_cast<T>(weak * e[0]), static_cast<T>(weak * e[1]),
                                    static_cast<T>(weak * e[2])};
    const auto retarder = malus::elliptical_retarder(T(1), fast, phase, Fixed{});
    const auto matrix =
        malus::partial_depolarizer<T, Fixed>(T(1), static_cast<T>(random.between(0.2, 1))) *
        propagate(retarder * propagate(malus::elliptical_diattenuator(weight, dichroic, Fixed{})));
    const auto rows = flat(matrix);
    std::array<Exact, 16> wide{};
    for (std::size_t j = 0; j < 16; ++j) wide[j] = rows[j];
    const auto polar = malus::polar_decomposition(matrix);
    bounds.compare(
        "polar_decomposition",
        flat(polar.depolarizer * propagate(polar.retarder * propagate(polar.diattenuator))), wide);
    bounds.compare("retardance", malus::retardance(polar.retarder), static_cast<Exact>(phase), pi);
    const auto parts = malus::cloude_decomposition(matrix);
    bounds.compare("cloude_decomposition", flat(parts[0] + parts[1] + (parts[2] + parts[3])), wide);
    const auto eigenvalues = malus::coherency_eigenvalues(retarder * static_cast<T>(size));
    bounds.compare("coherency_eigenvalues", eigenvalues,
                   {static_cast<Exact>(static_cast<T>(size)), 0, 0, 0});
    const Exact m00 = wide[0];
    bounds.compare("diattenuation", malus::diattenuation(matrix),
                   std::sqrt(wide[1] * wide[1] + wide[2] * wide[2] + wide[3] * wide[3]) / m00);
    bounds.compare("polarizance", malus::polarizance(matrix),
                   std::sqrt(wide[4] * wide[4] + wide[8] * wide[8] + wide[12] * wide[12]) / m00);
    Exact squares = 0;
    for (std::size_t j = 1; j < 16; ++j) squares += wide[j] * wide[j];
    bounds.compare("depolarization_index", malus::depolarization_index(matrix),
                   std::sqrt(squares / 3) / m00);
    bounds.compare("depolarization_power", malus::depolarization_power(matrix),
                   1 - std::abs(wide[5] + wide[10] + wide[15]) / m00 / 3, 1);
  }
}

template <class T>
void measure_values(Bounds& bounds) {
  using Spectrum = malus::Spectrum<T, 5>;
  Random random(16);
  for (int i = 0; i < 1000; ++i) {
    const auto value = [&] { return static_cast<T>(random.magnitude(1e-15, 1e15)); };
    const T a = value(), b = value();
    const Spectrum x(a), y(b);
    const Exact ea = a, eb = b;
    bounds.compare("Spectrum: + - * / sqrt", (x + y)[4], ea + eb);
    bounds.compare("Spectrum: + - * / sqrt", (x - y)[4], ea - eb);
    bounds.compare("Spectrum: + - * / sqrt", (x * y)[4], ea * eb);
    bounds.compare("Spectrum: + - * / sqrt", (x / y)[4], ea / eb);
    bounds.compare("Spectrum: + - * / sqrt", sqrt(x)[4], std::sqrt(ea));
    const Spectrum mixed(a, b, a, b, a);
    bounds.compare("max_channel", malus::max_channel(mixed), std::max(ea, eb));
    bounds.compare("mean_channel", malus::mean_channel(mixed), (3 * ea + 2 * eb) / 5);
  }
}

void measure_spheres(Bounds& bounds) {
  Random random(17);
  for (int i = 0; i < 200; ++i) {
    const double x = random.magnitude(0.01, 100);
    const std::complex<double> index(random.between(1.1, 2.5),
                                     random.unit() < 0.5 ? 0 : random.magnitude(1e-4, 5));
    const malus::MieSphere sphere(x, index);
    const ExactSphere right(x, Complex(index.real(), index.imag()));
    bounds.compare("MieSphere: efficiencies", sphere.extinction(), right.extinction());
    bounds.compare("MieSphere: efficiencies", sphere.scattering(), right.scattering());
    const double cosine = i % 10 == 0 ? random.sign() : random.between(-1, 1);
    const auto got = sphere.amplitudes(cosine);
    const auto [s1, s2] = right.amplitudes(cosine);
    const Exact forward = std::abs(right.amplitudes(1)[0]);
    bounds.compare("MieSphere::amplitudes",
                   std::array{got.s1.real(), got.s1.imag(), got.s2.real(), got.s2.imag()},
                   {s1.real(), s1.imag(), s2.real(), s2.imag()}, forward);
  }
}

TEST_CASE("accuracy: elements, scattering and media keep the bounds that the docs state") {
  struct Part {
    const char* heading;
    void (*wide)(Bounds&);
    void (*narrow)(Bounds&);
  };
  for (const auto& [heading, wide, narrow] :
       {Part{"Values", measure_values<double>, measure_values<float>},
        Part{"Elements", measure_elements<double>, measure_elements<float>},
        Part{"Scattering", measure_scattering<double>, measure_scattering<float>},
        Part{"Media", measure_media<double>, measure_media<float>},
        Part{"Rough surfaces", measure_facets<double>, measure_facets<float>},
        Part{"Analysis", measure_analysis<double>, measure_analysis<float>}}) {
    Bounds bounds(heading);
    wide(bounds);
    narrow(bounds);
    bounds.check();
  }
  Bounds bounds("Spheres");
  measure_spheres(bounds);
  bounds.check();
}

}  // namespace
