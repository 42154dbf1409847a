// SPDX-License-Identifier: MIT
// Products of Mueller matrices with each other and with light, by Malus and by what GLM and Eigen
// make of them: nanoseconds an operation, in one run, interleaved. Before an operation is timed,
// all columns are found to give the same numbers to rounding. The frames of the others are turned
// by Malus's coefficients, which take no trigonometry, so that what is compared is the algebra.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <malus/product.hpp>

#include "../algebra/inputs.hpp"
#include "../algebra/types.hpp"
#include "representations.hpp"

namespace {

using namespace representations;
using inputs::Place;
using malus::MuellerForm, malus::StokesForm;

const std::vector<std::string>& columns() {
  static const std::vector<std::string> list{"Malus", "GLM",
#ifdef MALUS_HAVE_EIGEN
                                             "Eigen, matrices", "Eigen, arrays"
#endif
  };
  return list;
}

struct Table {
  std::vector<std::string> rows;                           // as they were added
  std::map<std::string, std::vector<double>> nanoseconds;  // by row and column, of each repetition
};
Table table;

// results as lists of numbers: colours outermost, rows before columns

template <class At>
std::vector<double> vector_numbers(const At& at) {
  std::vector<double> list;
  for (std::size_t i = 0; i < channels; ++i)
    for (int r = 0; r < 4; ++r) list.push_back(static_cast<double>(at(i, r)));
  return list;
}

template <class At>
std::vector<double> matrix_numbers(const At& at) {
  std::vector<double> list;
  for (std::size_t i = 0; i < channels; ++i)
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) list.push_back(static_cast<double>(at(i, r, c)));
  return list;
}

template <class R, class Result>
std::vector<double> numbers(const Result& result) {
  if constexpr (requires { result.value; })
    return numbers<R>(result.value);
  else if constexpr (std::is_same_v<Result, typename R::Vector>)
    return vector_numbers([&](std::size_t i, int r) { return R::at(result, i, r); });
  else
    return matrix_numbers([&](std::size_t i, int r, int c) { return R::at(result, i, r, c); });
}

template <class Result>
std::vector<double> own_numbers(const Result& result) {
  if constexpr (malus::MuellerType<Result>)
    return matrix_numbers([&](std::size_t i, int r, int c) { return result.to_mat4(i)[c][r]; });
  else
    return vector_numbers([&](std::size_t i, int r) { return result.to_vec4(i)[r]; });
}

/// Equal but for the rounding of the sums, which are of 16 products at most and turned once.
template <class T>
void check(const std::string& name, const std::vector<double>& expected,
           const std::vector<double>& actual) {
  double scale = 0;
  for (const double x : expected) scale = std::max(scale, std::abs(x));
  const double tolerance = 32 * static_cast<double>(std::numeric_limits<T>::epsilon()) * scale;
  bool agree = expected.size() == actual.size();
  for (std::size_t k = 0; agree && k < expected.size(); ++k)
    agree = std::abs(expected[k] - actual[k]) <= tolerance;
  if (agree) return;
  std::fprintf(stderr, "benchmark_peers: %s: differs from GLM's result\n", name.c_str());
  std::exit(1);
}

/// As benchmarks/algebra does: results are made in memory, and never across two of its pages.
template <class Operation>
void add_column(const std::string& name, std::size_t n, Operation operation) {
  benchmark::RegisterBenchmark(name.c_str(), [n, operation](benchmark::State& state) {
    while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(n))) {
      for (std::size_t i = 0; i < n; ++i) {
        alignas(1024) const auto result = operation(i);
        benchmark::DoNotOptimize(&result);
      }
    }
  });
}

template <class R, class T>
auto framed_matrices(std::span<const naive::Mueller<T>> operands) {
  std::vector<FramedMatrix<typename R::Matrix, T>> result;
  for (const auto& m : operands) result.push_back({R::matrix(m.value), m.enter, m.exit});
  return inputs::kept(std::move(result));
}

template <class R, class T>
auto framed_vectors(std::span<const naive::Stokes<T>> operands) {
  std::vector<FramedVector<typename R::Vector, T>> result;
  for (const auto& s : operands) result.push_back({R::vector(s.value), s.frame});
  return inputs::kept(std::move(result));
}

template <class Q>
auto values(std::span<const Q> framed) {
  std::vector<decltype(Q::value)> result;
  for (const Q& x : framed) result.push_back(x.value);
  return inputs::kept(std::move(result));
}

/// The operands of one row; R is a representation.
template <class T, MuellerForm Form>
struct Row {
  static constexpr std::size_t n = inputs::count<T>;
  std::span<const naive::Mueller<T>> first =
                                         inputs::matrices<T>(Place::first, Place::second, 1, Form),
                                     second =
                                         inputs::matrices<T>(Place::second, Place::third, 5, Form);
  std::span<const naive::Stokes<T>> light = inputs::lights<T>(Place::first, 9);
  std::string prefix = sizeof(T) == 4 ? "float/" : "double/";

  /// Calls use with each of the representations.
  template <class Use>
  static void for_each_representation(const Use& use) {
    use(std::type_identity<PerColour<GlmAlgebra<T>>>{}, columns()[1]);
#ifdef MALUS_HAVE_EIGEN
    use(std::type_identity<PerColour<EigenAlgebra<T>>>{}, columns()[2]);
    use(std::type_identity<EigenArrays<T>>{}, columns()[3]);
#endif
  }

  /// ours(i), and others(R) gives the operation in the representation R.
  template <class Ours, class Others>
  void add(const std::string& operation, const Ours& ours, const Others& others) const {
    const std::string row = prefix + operation;
    table.rows.push_back(row);
    const auto expected = others(std::type_identity<PerColour<GlmAlgebra<T>>>{});
    for (std::size_t i = 0; i < n; ++i)
      check<T>(row + "/" + columns()[0], numbers<PerColour<GlmAlgebra<T>>>(expected(i)),
               own_numbers(ours(i)));
    add_column(row + "/" + columns()[0], n, ours);
    for_each_representation([&]<class R>(std::type_identity<R> id, const std::string& column) {
      const auto theirs = others(id);
      for (std::size_t i = 0; i < n; ++i)
        check<T>(row + "/" + column, numbers<PerColour<GlmAlgebra<T>>>(expected(i)),
                 numbers<R>(theirs(i)));
      add_column(row + "/" + column, n, theirs);
    });
  }

  /// What is known to be in one frame carries none.
  void add_in_one_frame(const std::string& name) const {
    using F = types::Shared<T>;
    const auto m = inputs::as<types::Scatter<T, Form, F>>(first);
    const auto n_ = inputs::as<types::Transmit<T, Form, F>>(second);
    const auto s = inputs::as<types::Light<T, StokesForm::full, F>>(light);
    add(
        name + " · light, one frame", [=](std::size_t i) { return m[i] * s[i]; },
        [this]<class R>(std::type_identity<R>) {
          const auto a = values(framed_matrices<R>(first));
          const auto b = values(framed_vectors<R>(light));
          return [=](std::size_t i) { return R::product(a[i], b[i]); };
        });
    add(
        name + " · " + name + ", one frame", [=](std::size_t i) { return n_[i] * m[i]; },
        [this]<class R>(std::type_identity<R>) {
          const auto a = values(framed_matrices<R>(second)), b = values(framed_matrices<R>(first));
          return [=](std::size_t i) { return R::product(a[i], b[i]); };
        });
  }

  void add_with_frames(const std::string& name) const {
    const auto m = inputs::as<types::Scatter<T, Form>>(first);
    const auto n_ = inputs::as<types::Transmit<T, Form>>(second);
    const auto s = inputs::as<types::Light<T, StokesForm::full>>(light);
    add(
        name + " · light, frames", [=](std::size_t i) { return m[i] * s[i]; },
        [this]<class R>(std::type_identity<R>) {
          const auto a = framed_matrices<R>(first);
          const auto b = framed_vectors<R>(light);
          return [=](std::size_t i) {
            const auto turn = malus::rotation(b[i].frame, a[i].enter);
            return FramedVector<typename R::Vector, T>{
                R::product(a[i].value, R::turned(b[i].value, turn)), a[i].exit};
          };
        });
    add(
        name + " · " + name + ", frames", [=](std::size_t i) { return n_[i] * m[i]; },
        [this]<class R>(std::type_identity<R>) {
          const auto a = framed_matrices<R>(second), b = framed_matrices<R>(first);
          return [=](std::size_t i) {
            const auto turn = malus::rotation(b[i].exit, a[i].enter);
            return FramedMatrix<typename R::Matrix, T>{
                R::product(a[i].value, R::turned(b[i].value, turn)), b[i].enter, a[i].exit};
          };
        });
  }
};

template <class T>
void add_rows() {
  Row<T, MuellerForm::full>{}.add_in_one_frame("full");
  Row<T, MuellerForm::full>{}.add_with_frames("full");
  Row<T, MuellerForm::block>{}.add_in_one_frame("block");
  Row<T, MuellerForm::block>{}.add_with_frames("block");
}

class Reporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override {
    PrintBasicContext(&GetErrorStream(), context);
    return true;
  }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration && !run.error_occurred)
        table.nanoseconds[run.run_name.function_name].push_back(
            run.GetAdjustedCPUTime() * 1e9 / benchmark::GetTimeUnitMultiplier(run.time_unit));
  }
};

double median(std::vector<double> times) {
  if (times.empty()) return 0;
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

void print() {
  std::string precision;
  for (const std::string& row : table.rows) {
    const double own = median(table.nanoseconds[row + "/" + columns()[0]]);
    if (!(own > 0)) continue;  // filtered out
    const auto slash = row.find('/');
    if (row.substr(0, slash) != precision) {
      precision = row.substr(0, slash);
      std::printf("\n### RGB, %s: ns, and times Malus's\n\n| operation |", precision.c_str());
      for (const auto& column : columns()) std::printf(" %s |", column.c_str());
      std::printf("\n|---|");
      for (std::size_t k = 0; k < columns().size(); ++k) std::printf("--:|");
      std::printf("\n");
    }
    std::printf("| %s | %.2f |", row.c_str() + slash + 1, own);
    for (std::size_t k = 1; k < columns().size(); ++k) {
      const double time = median(table.nanoseconds[row + "/" + columns()[k]]);
      std::printf(" %.2f (%.1f ×) |", time, time / own);
    }
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  // The defaults stand first, so that the command line overrules them.
  std::string defaults[] = {"--benchmark_repetitions=21", "--benchmark_min_time=0.01",
                            "--benchmark_enable_random_interleaving=true"};
  std::vector<char*> arguments{argv[0]};
  for (std::string& option : defaults) arguments.push_back(option.data());
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
#ifndef MALUS_HAVE_EIGEN
  std::fprintf(stderr,
               "Eigen: skipped: not found when this was configured (Debian: libeigen3-dev)\n");
#endif
  add_rows<float>();
  add_rows<double>();
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  print();
  return 0;
}
