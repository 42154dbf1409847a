// SPDX-License-Identifier: MIT
// Runs every operation in its three columns, in one run and interleaved, and prints the medians as
// Markdown. Takes Google Benchmark's options, as --benchmark_filter=float/.
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "comparison.hpp"
#include "operations.hpp"

namespace {

class Table : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override {
    PrintBasicContext(&GetErrorStream(), context);
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration && !run.error_occurred)
        nanoseconds_[run.run_name.function_name].push_back(
            run.GetAdjustedCPUTime() * 1e9 / benchmark::GetTimeUnitMultiplier(run.time_unit));
  }

  void Finalize() override {
    std::string table;
    for (const std::string& row : comparison::row_order()) {
      const double naive = median(row, comparison::naive_column),
                   run_time = median(row, comparison::run_time_column),
                   compile_time = median(row, comparison::compile_time_column);
      if (!(naive > 0 && run_time > 0 && compile_time > 0)) continue;  // filtered out
      const auto slash = row.find('/');
      if (const std::string precision = row.substr(0, slash); precision != table) {
        table = precision;
        std::printf("\n### RGB, %s\n\n", table.c_str());
        std::printf(
            "| operation | naive, ns | run time, ns | compile time, ns | naive : run time "
            "| naive : compile time |\n|---|--:|--:|--:|--:|--:|\n");
      }
      std::printf("| %s | %.2f | %.2f | %.2f | %.1f | %.1f |\n", row.c_str() + slash + 1, naive,
                  run_time, compile_time, naive / run_time, naive / compile_time);
    }
  }

 private:
  double median(const std::string& row, const char* column) const {
    const auto found = nanoseconds_.find(row + "/" + column);
    if (found == nanoseconds_.end()) return 0;
    auto times = found->second;
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end());
    return *middle;
  }

  std::map<std::string, std::vector<double>> nanoseconds_;  // of each repetition, by benchmark
};

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

  for (const auto add_rows : {operations::add_rows<float>, operations::add_rows<double>})
    add_rows();
  Table table;
  benchmark::RunSpecifiedBenchmarks(&table);
  return 0;
}
