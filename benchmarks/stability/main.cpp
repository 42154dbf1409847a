// SPDX-License-Identifier: MIT
// What becomes of light behind 10 … 10⁷ random elements, in float and double against long double.
//
//   benchmark_stability --json stability.json
//   benchmarks/stability/plot.py stability.json -o stability.png
//
// Light starts fully polarised. For each kind of element and precision: the relative error (of the
// largest component, over the intensity), geometric mean and largest of the chains, by the number
// of elements; the law it grows by, an exponent with its interval of 95 % (½ of a random walk, 1 of
// a drift); the relative drift of the degree of polarisation with its standard error; and how many
// of all states of light on the way have a degree of polarisation above 1, and by how much, or an
// intensity below 0. Short
// chains are many, the longest few. The second kind of rotation is there to be seen to drift.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../program.hpp"
#include "chain.hpp"
#include "growth.hpp"
#include "io/atomic_file.hpp"
#include "io/input_error.hpp"

namespace {

using namespace stability;

struct Arguments {
  std::string json;
  double longest = 1e6;
  double from = 30;
  std::uint64_t seed = 1;
};

struct Point {
  std::uint64_t elements = 0;
  std::size_t chains = 0;
  double error = 0, worst = 0;        ///< geometric mean and largest of the chains
  double drift = 0, drift_error = 0;  ///< of the degree of polarisation: mean, standard error
};

struct Result {
  Kind kind{};
  bool is_double = false;
  std::vector<Point> points;
  Growth error, degree;
  std::uint64_t states = 0, beyond_one = 0, negative = 0, not_finite = 0;
  double largest_degree = 0;
};

struct Plan {
  std::uint64_t length;
  std::size_t chains;
};
/// As much work goes into each length as into the longest, but for what the shortest can use.
std::vector<Plan> plans(std::uint64_t longest) {
  std::vector<Plan> list;
  std::size_t chains = 4;
  for (std::uint64_t length = longest; length >= 10 && chains <= 256; length /= 10, chains *= 4)
    list.push_back({length, chains});
  return list;
}

Point summarize(const std::vector<Chain>& chains, std::size_t at, std::uint64_t elements) {
  Point point;
  point.elements = elements;
  double logarithms = 0, counted = 0, sum = 0, sum2 = 0;
  for (const Chain& chain : chains)
    if (at < chain.error.size()) {
      const Error& e = chain.error[at];
      if (e.relative != 0) logarithms += std::log(e.relative), ++counted;
      point.worst = std::max(point.worst, e.relative);
      sum += e.degree, sum2 += e.degree * e.degree;
      ++point.chains;
    }
  const double count = static_cast<double>(point.chains);
  point.error = counted > 0 ? std::exp(logarithms / counted) : 0;
  point.drift = sum / count;
  const double variance = std::max(sum2 / count - point.drift * point.drift, 0.0);
  point.drift_error = point.chains > 1 ? std::sqrt(variance / (count - 1)) : 0;
  return point;
}

Result measure(const Arguments& a, Kind kind, bool is_double) {
  Result result;
  result.kind = kind;
  result.is_double = is_double;
  std::vector<Chain> chains;
  std::uint64_t seed = a.seed * 1000003;
  for (const Plan& plan : plans(static_cast<std::uint64_t>(a.longest)))
    for (std::size_t i = 0; i < plan.chains; ++i)
      chains.push_back(run_chain(kind, is_double, plan.length, ++seed));
  const auto looks = checkpoints(static_cast<std::uint64_t>(a.longest));
  std::vector<std::vector<double>> errors, degrees;
  for (const Chain& chain : chains) {
    errors.emplace_back();
    degrees.emplace_back();
    for (const Error& e : chain.error) {
      errors.back().push_back(e.relative);
      degrees.back().push_back(e.degree);
    }
    result.states += chain.states;
    result.beyond_one += chain.beyond_one;
    result.negative += chain.negative;
    result.not_finite += chain.not_finite;
    result.largest_degree = std::max(result.largest_degree, chain.largest_degree);
  }
  for (std::size_t i = 0; i < looks.size(); ++i)
    result.points.push_back(summarize(chains, i, looks[i]));
  const auto from = static_cast<std::uint64_t>(a.from);
  result.error = fit_growth(looks, errors, from);
  result.degree = fit_growth(looks, degrees, from);
  return result;
}

void print(const Result& r) {
  const Point& last = r.points.back();
  std::printf(
      "| %s | %s | %.1e | %.1e | %.1e | %.1e | %.2f (%.2f…%.2f) | %+.1e ± %.0e | %.2f (%.2f…%.2f) "
      "| "
      "%.3g %% | %.1e | %llu | %llu |\n",
      kind_names[static_cast<int>(r.kind)], r.is_double ? "double" : "float", r.points[0].error,
      r.points[std::min<std::size_t>(4, r.points.size() - 1)].error, last.error, last.worst,
      r.error.exponent, r.error.low, r.error.high, last.drift, last.drift_error, r.degree.exponent,
      r.degree.low, r.degree.high,
      100 * static_cast<double>(r.beyond_one) / static_cast<double>(r.states),
      std::max(r.largest_degree - 1, 0.0), static_cast<unsigned long long>(r.negative),
      static_cast<unsigned long long>(r.not_finite));
  std::fflush(stdout);
}

nlohmann::ordered_json to_json(const Growth& g) {
  return {{"exponent", g.exponent}, {"low", g.low}, {"high", g.high}};
}
nlohmann::ordered_json to_json(const Result& r) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const Point& p : r.points)
    points.push_back({{"elements", p.elements},
                      {"chains", p.chains},
                      {"relative_error", p.error},
                      {"largest_relative_error", p.worst},
                      {"dop_drift", p.drift},
                      {"dop_drift_standard_error", p.drift_error}});
  return {{"kind", kind_names[static_cast<int>(r.kind)]},
          {"precision", r.is_double ? "double" : "float"},
          {"error_growth", to_json(r.error)},
          {"dop_growth", to_json(r.degree)},
          {"states", r.states},
          {"states_with_dop_above_1", r.beyond_one},
          {"largest_dop_excess", std::max(r.largest_degree - 1, 0.0)},
          {"states_of_negative_intensity", r.negative},
          {"states_not_finite", r.not_finite},
          {"points", points}};
}

int run(const Arguments& a) {
  benchmarks::reject_nan("--longest", a.longest);
  benchmarks::reject_nan("--fit-from", a.from);
  if (a.from * 10 > a.longest)
    throw renderer::InputError("--fit-from: at most a tenth of --longest");
  if (!a.json.empty()) renderer::check_writable(a.json);
  std::printf(
      "| elements | precision | error behind 10 | 1000 | %.0e | largest | grows as n to the | DoP "
      "off by, "
      "behind %.0e | grows as n to the | DoP above 1 | at most by | S0 below 0 | not finite |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
      a.longest, a.longest);
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Kind kind : {Kind::rotations, Kind::undivided, Kind::retarders, Kind::fresnel,
                          Kind::rayleigh, Kind::full})
    for (const bool is_double : {false, true}) {
      const Result result = measure(a, kind, is_double);
      print(result);
      json.push_back(to_json(result));
    }
  if (!a.json.empty()) renderer::write_file(a.json, json.dump(2) + "\n");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Errors of light behind long chains of elements, against long double",
               "benchmark_stability");
  Arguments a;
  app.add_option("--longest", a.longest, "Elements of the longest chains")
      ->check(CLI::Range(1e3, 1e8))
      ->capture_default_str();
  app.add_option("--fit-from", a.from, "Elements from which on the law of growth is fitted")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  app.add_option("--seed", a.seed)->check(CLI::Range(1, 1000000))->capture_default_str();
  app.add_option("--json", a.json, "File of the same numbers, at all lengths");
  return benchmarks::run_program(app, argc, argv, [&] { return run(a); });
}
