// SPDX-License-Identifier: MIT
// One row of the table: an operation in three columns, checked to give the same numbers before any
// is timed.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <malus/measurement.hpp>

#include "inputs.hpp"

namespace comparison {

inline constexpr const char *naive_column = "naive", *run_time_column = "run time",
                            *compile_time_column = "compile time";

template <class T>
constexpr const char* precision = sizeof(T) == 4 ? "float" : "double";

// results of all columns as plain lists of numbers

template <class T, std::size_t N>
void append(std::vector<double>& list, const std::array<glm::mat<4, 4, T>, N>& value) {
  for (const auto& m : value)
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) list.push_back(static_cast<double>(m[c][r]));
}
template <class T, std::size_t N>
void append(std::vector<double>& list, const std::array<glm::vec<4, T>, N>& value) {
  for (const auto& s : value)
    for (int r = 0; r < 4; ++r) list.push_back(static_cast<double>(s[r]));
}

template <class Result>
std::vector<double> numbers(const Result& result) {
  using namespace malus;
  std::vector<double> list;
  if constexpr (MuellerType<Result> || ImportanceType<Result>) {
    for (std::size_t i = 0; i < naive::channels; ++i) append(list, std::array{result.to_mat4(i)});
  } else if constexpr (StokesType<Result> || MeasurementType<Result>) {
    for (std::size_t i = 0; i < naive::channels; ++i) append(list, std::array{result.to_vec4(i)});
  } else if constexpr (AnalyzerType<Result>) {
    for (std::size_t i = 0; i < naive::channels; ++i)
      for (std::size_t r = 0; r < 4; ++r) list.push_back(static_cast<double>(result[r][i]));
  } else if constexpr (requires { result.value; }) {
    append(list, result.value);
  } else if constexpr (requires { result[0][0]; }) {
    append(list, result);
  } else {
    for (std::size_t i = 0; i < naive::channels; ++i)
      list.push_back(static_cast<double>(result[i]));
  }
  return list;
}

template <class Ours, class Naive>
void check_agreement(const std::string& name, std::size_t n, Ours&& ours, Naive&& naive) {
  for (std::size_t i = 0; i < n; ++i) {
    const auto a = numbers(ours(i)), b = numbers(naive(i));
    bool agree = a.size() == b.size();
    for (std::size_t k = 0; agree && k < a.size(); ++k) agree = std::abs(a[k] - b[k]) < 1e-4;
    if (!agree) {
      std::fprintf(stderr, "%s: element %zu differs from the naive result\n", name.c_str(), i);
      std::exit(1);
    }
  }
}

// timing

/// operation(i) for all i below n, over and over; the time is that of one. The result is made in
/// memory, as a renderer would store it, and its address escapes, so that all of it has to be
/// there. It never lies across two pages of memory, which would cost more than most operations and
/// depend on nothing but chance.
template <class Operation>
void time(benchmark::State& state, std::size_t n, const Operation operation) {
  while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(n))) {
    for (std::size_t i = 0; i < n; ++i) {
      alignas(1024) const auto result = operation(i);
      benchmark::DoNotOptimize(&result);
    }
  }
}

/// The rows as they were added: benchmarks that run interleaved end in any order.
inline std::vector<std::string>& row_order() {
  static std::vector<std::string> rows;
  return rows;
}

template <class Operation>
void add_column(const std::string& row, const char* column, std::size_t n, Operation operation) {
  benchmark::RegisterBenchmark(
      (row + "/" + column).c_str(),
      [n, operation](benchmark::State& state) { time(state, n, operation); });
}

template <class T, class Naive, class RunTime, class CompileTime>
void add_row(std::string_view operation, const Naive& naive, const RunTime& run_time,
             const CompileTime& compile_time, std::size_t n = inputs::count<T>) {
  const std::string row = std::string(precision<T>) + "/" + std::string(operation);
  row_order().push_back(row);
  check_agreement(row + "/" + run_time_column, n, run_time, naive);
  check_agreement(row + "/" + compile_time_column, n, compile_time, naive);
  add_column(row, naive_column, n, naive);
  add_column(row, run_time_column, n, run_time);
  add_column(row, compile_time_column, n, compile_time);
}

}  // namespace comparison
