// SPDX-License-Identifier: MIT
// What an operation costs and how far it is off: nanoseconds against units in the last place.
//
//   benchmark_accuracy --json accuracy.json
//   benchmarks/accuracy/plot.py accuracy.json -o accuracy.png
//
// The library's algebra on RGB, in float and double, compiled three times: "strict" (each rounding
// as written, -ffp-contract=off), "contracted" (fused multiply-adds where the processor has them,
// which is GCC's default) and "fast" (-ffast-math). Rotations are the library's, which divides by
// c² + s² and so stays a rotation where axes are slightly off ("divided"); the same by two
// divisions instead of one and two products ("quotients"); without any ("undivided"); and by atan2,
// cos and sin ("angles").
//
// Errors are differences from quadruple precision's result of the same rounded operands (exact.hpp)
// in units in the last place of the largest component of the result (of a channel): a component
// that nearly cancels is not held against an operation. Of light there is also the change of the
// degree of polarisation, relative. Times are the least of rounds in which all ways and builds
// take turns; of a chain they are one element's.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../program.hpp"
#include "exact.hpp"
#include "inputs.hpp"
#include "io/atomic_file.hpp"

extern "C" {
double malus_accuracy_strict(const accuracy::Request&);
double malus_accuracy_contracted(const accuracy::Request&);
double malus_accuracy_fast(const accuracy::Request&);
}

namespace {

using namespace accuracy;

struct Arguments {
  std::string json;
  std::size_t operands = 20000;
  int rounds = 15;
  double seconds = 0.002;
  std::uint64_t seed = 1;
};

struct Build {
  const char* name;
  Entry entry;
};
constexpr Build builds[] = {{"strict", malus_accuracy_strict},
                            {"contracted", malus_accuracy_contracted},
                            {"fast", malus_accuracy_fast}};
constexpr const char* turning_names[] = {"divided", "quotients", "undivided", "angles"};

struct Task {
  const char* name;
  Operation operation;
  std::size_t chain_length;
  bool turns;
};
constexpr Task tasks[] = {
    {"rotation's coefficients", Operation::coefficients, 0, true},
    {"rotate Stokes", Operation::rotate_stokes, 0, true},
    {"Mueller × Stokes", Operation::mueller_stokes, 0, true},
    {"Mueller × Mueller", Operation::mueller_mueller, 0, true},
    {"Fresnel, dielectric", Operation::dielectric, 0, false},
    {"Fresnel, conductor", Operation::conductor, 0, false},
    {"chain of 100", Operation::chain, 100, true},
    {"chain of 1000", Operation::chain, 1000, true},
};

struct Row {
  std::string operation, precision, turning, build;
  double nanoseconds = 0;
  double ulp_max = 0, ulp_rms = 0, relative_rms = 0;
  double degree_max = 0, degree_rms = 0,
         degree_mean = 0;  ///< of the degree of polarisation's relative error
  bool has_degree = false;
};

/// The size of the last place of a number in a precision.
double last_place(double value, bool is_double) {
  return std::ldexp(1.0, std::ilogb(value) - (is_double ? 52 : 23));
}

/// Of errors: the greatest, the mean and the root of the mean square.
struct Spread {
  double most = 0, square = 0, sum = 0;
  std::size_t count = 0;

  void add(double value) {
    // A NaN is not to be passed over.
    most = std::abs(value) <= most ? most : std::abs(value);
    square += value * value;
    sum += value;
    ++count;
  }
  double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
  double rms() const { return count > 0 ? std::sqrt(square / static_cast<double>(count)) : 0; }
};

double degree_of(const Exact (&s)[4]) {
  const Exact length2 = s[1] * s[1] + s[2] * s[2] + s[3] * s[3];
  // The ratio's square is of ordinary size, and its error what is looked for.
  return std::sqrt(static_cast<double>(length2 / (s[0] * s[0])));
}

/// Relative error of the degree of polarisation: half that of its square, which is compared in full
/// precision.
double degree_error(const Exact (&got)[4], const Exact (&exact)[4]) {
  const auto square = [](const Exact(&s)[4]) {
    return (s[1] * s[1] + s[2] * s[2] + s[3] * s[3]) / (s[0] * s[0]);
  };
  return static_cast<double>((square(got) - square(exact)) / (2 * square(exact)));
}

bool gives_light(Operation operation) {
  return operation == Operation::rotate_stokes || operation == Operation::mueller_stokes ||
         operation == Operation::chain;
}

/// Where in a result the components of a channel are.
std::size_t place(Operation operation, std::size_t component, std::size_t channel) {
  return operation == Operation::coefficients ? component : channels * component + channel;
}

void judge(Operation operation, bool is_double, const std::vector<double>& results,
           const std::vector<std::vector<Exact>>& exact, Row& row) {
  Spread ulps, relative, degree;
  const std::size_t size = result_count(operation);
  const std::size_t width = operation == Operation::coefficients ? 1 : channels;
  for (std::size_t i = 0; i < exact.size(); ++i)
    for (std::size_t c = 0; c < width; ++c) {
      double largest = 0;
      for (std::size_t k = 0; k < size / width; ++k)
        largest =
            std::max(largest, std::abs(static_cast<double>(exact[i][place(operation, k, c)])));
      const double unit = last_place(largest, is_double);
      for (std::size_t k = 0; k < size / width; ++k) {
        const std::size_t at = place(operation, k, c);
        const Exact got = static_cast<Exact>(results[i * size + at]);
        const double off = std::abs(static_cast<double>(got - exact[i][at]));
        ulps.add(off / unit);
        relative.add(off / largest);
      }
      if (!gives_light(operation)) continue;
      Exact got[4], right[4];
      for (std::size_t k = 0; k < 4; ++k) {
        got[k] = static_cast<Exact>(results[i * size + place(operation, k, c)]);
        right[k] = exact[i][place(operation, k, c)];
      }
      if (degree_of(right) > 0.05) degree.add(degree_error(got, right));
    }
  row.ulp_max = ulps.most;
  row.ulp_rms = ulps.rms();
  row.relative_rms = relative.rms();
  row.has_degree = gives_light(operation);
  row.degree_max = degree.most;
  row.degree_rms = degree.rms();
  row.degree_mean = degree.mean();
}

/// All turnings and builds of an operation in one precision.
std::vector<Row> measure(const Arguments& a, const Task& task, bool is_double) {
  const bool is_chain = task.operation == Operation::chain;
  const std::size_t count =
      is_chain ? std::max<std::size_t>(4, 2 * a.operands / task.chain_length) : a.operands;
  const auto operands = random_operands(count, is_double, a.seed);
  const auto elements = random_chains(is_chain ? count : 0, task.chain_length, is_double, a.seed);
  std::vector<std::vector<Exact>> exact;
  for (std::size_t i = 0; i < count; ++i)
    exact.push_back(compute_exactly(task.operation, operands[i],
                                    elements.data() + i * task.chain_length, task.chain_length));

  const std::size_t turnings = task.turns ? std::size(turning_names) : 1;
  std::vector<Row> rows;
  std::vector<double> results(count * result_count(task.operation));
  Request request{task.operation,
                  Turning::divided,
                  is_double,
                  operands.data(),
                  count,
                  elements.data(),
                  task.chain_length,
                  results.data(),
                  0,
                  0};
  for (std::size_t i = 0; i < turnings * std::size(builds); ++i) {
    const std::size_t turning = i / std::size(builds);
    const Build& build = builds[i % std::size(builds)];
    Row row{task.name, is_double ? "double" : "float", task.turns ? turning_names[turning] : "",
            build.name};
    request.turning = static_cast<Turning>(turning);
    build.entry(request);
    judge(task.operation, is_double, results, exact, row);
    rows.push_back(row);
  }
  request.results = nullptr;
  request.seconds = a.seconds;
  for (int round = 0; round < a.rounds; ++round)
    for (std::size_t i = 0; i < rows.size(); ++i) {
      request.turning = static_cast<Turning>(i / std::size(builds));
      request.shift = static_cast<std::size_t>(round);
      const double time = builds[i % std::size(builds)].entry(request);
      rows[i].nanoseconds = round == 0 ? time : std::min(rows[i].nanoseconds, time);
    }
  return rows;
}

void print(const Row& row) {
  std::printf("| %s | %s | %s | %s | %.2f | %.2f | %.3f | %.1e |", row.operation.c_str(),
              row.precision.c_str(), row.turning.c_str(), row.build.c_str(), row.nanoseconds,
              row.ulp_max, row.ulp_rms, row.relative_rms);
  if (row.has_degree)
    std::printf(" %.1e | %.1e | %+.1e |\n", row.degree_max, row.degree_rms, row.degree_mean);
  else
    std::printf(" | | |\n");
}

nlohmann::ordered_json to_json(const Row& row) {
  nlohmann::ordered_json json{{"operation", row.operation},     {"precision", row.precision},
                              {"turning", row.turning},         {"build", row.build},
                              {"nanoseconds", row.nanoseconds}, {"ulp_max", row.ulp_max},
                              {"ulp_rms", row.ulp_rms},         {"relative_rms", row.relative_rms}};
  if (row.has_degree) {
    json["dop_max"] = row.degree_max;
    json["dop_rms"] = row.degree_rms;
    json["dop_mean"] = row.degree_mean;
  }
  return json;
}

int run(const Arguments& a) {
  benchmarks::reject_nan("--seconds", a.seconds);
  if (!a.json.empty()) renderer::check_writable(a.json);
  std::printf(
      "| operation | precision | rotations | build | ns | ulp, max | ulp, rms | relative error, "
      "rms | DoP off by, max | rms | mean |\n|---|---|---|---|--:|--:|--:|--:|--:|--:|--:|\n");
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Task& task : tasks)
    for (const bool is_double : {false, true}) {
      for (const Row& row : measure(a, task, is_double)) {
        print(row);
        json.push_back(to_json(row));
      }
      std::fflush(stdout);
    }
  if (!a.json.empty()) renderer::write_file(a.json, json.dump(2) + "\n");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Nanoseconds an operation against units in the last place", "benchmark_accuracy");
  app.footer(
      "Rotations: divided by c² + s² by one division and two products, as the library does; by two "
      "quotients;\nundivided; by angles (atan2, cos, sin). Builds: strict (-ffp-contract=off), "
      "contracted (fused multiply-adds), fast "
      "(-ffast-math). Units in the last place are those of\nthe largest component of a result.");
  Arguments a;
  app.add_option("--operands", a.operands, "Random operands of every operation")
      ->check(CLI::Range(100, 10'000'000))
      ->capture_default_str();
  app.add_option("--rounds", a.rounds, "That the builds take turns in")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--seconds", a.seconds, "Of a build in a round")
      ->check(CLI::Range(1e-5, 100.0))
      ->capture_default_str();
  app.add_option("--seed", a.seed)->capture_default_str();
  app.add_option("--json", a.json, "File of the same rows");
  return benchmarks::run_program(app, argc, argv, [&] { return run(a); });
}
