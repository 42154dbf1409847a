// SPDX-License-Identifier: MIT
// Records how the summaries of every scene with every integrator are distributed over seeds, or
// checks a scene against that. It guards against changes that nobody meant; that the pictures were
// right when they were recorded other tests show.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "summary.hpp"

namespace {

using nlohmann::json;

/// The seeds that are recorded begin here; the one that is checked is another.
constexpr unsigned recorded_seeds = 32, first_seed = 1000, checked_seed = 7;

/// Some 3000 numbers are compared. Were they normal, with standard deviations from 32 seeds, one
/// suite in ten thousand would have one this far out by chance (Student's t with 31 degrees of
/// freedom, two sides: 2e-8 beyond 7.3); being bounded, their tails end sooner.
constexpr double most_deviations = 7.3;

/// Besides, for what most seeds see nothing of: a block has 64 pixels, each of them at most 1.
constexpr double rare_pixels = 0.005;

/// To a millionth.
double rounded(double x) { return std::round(x * 1e6) / 1e6; }

json distribution_of(const std::vector<guard::Summary>& summaries) {
  json means = json::array(), deviations = json::array();
  const auto n = static_cast<double>(summaries.size());
  for (std::size_t i = 0; i < summaries[0].size(); ++i) {
    double sum = 0, squares = 0;
    for (const auto& summary : summaries) sum += summary[i];
    for (const auto& summary : summaries) squares += std::pow(summary[i] - sum / n, 2);
    means.push_back(rounded(sum / n));
    // That of one more seed from the mean of these.
    deviations.push_back(rounded(std::sqrt(squares / (n - 1) * (1 + 1 / n))));
  }
  return {{"mean", means}, {"deviation", deviations}};
}

int record(const std::filesystem::path& file, const std::filesystem::path& scenes) {
  json all;
  for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
    if (entry.path().extension() != ".xml") continue;
    const std::string name = entry.path().stem().string();
    double scale = 0;
    for (const std::string& integrator : guard::integrators()) {
      std::vector<guard::Summary> summaries;
      for (unsigned seed = first_seed; seed < first_seed + recorded_seeds; ++seed)
        if (auto summary = guard::summarize(entry.path(), integrator, seed, scale))
          summaries.push_back(std::move(*summary));
      if (!summaries.empty()) all[name]["integrators"][integrator] = distribution_of(summaries);
    }
    all[name]["scale"] = scale;
    std::printf("%s\n", name.c_str());
    std::fflush(stdout);
  }
  std::ofstream(file) << all.dump() << '\n';
  return 0;
}

/// Returns whether all numbers are where they were.
bool check_integrator(const json& recorded, const std::string& name, const guard::Summary& now) {
  const auto& means = recorded.at("mean");
  if (means.size() != now.size()) {
    std::printf("%s: %zu numbers, recorded %zu\n", name.c_str(), now.size(), means.size());
    return false;
  }
  double worst = 0;
  std::size_t where = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double deviation = recorded.at("deviation")[i].get<double>();
    const double allowed = most_deviations * deviation + rare_pixels;
    const double off = std::abs(now[i] - means[i].get<double>()) / allowed;
    if (off > worst || !std::isfinite(off)) {
      worst = off;
      where = i;
    }
  }
  const bool fits = worst <= 1;
  std::printf(
      "%-8s at most %3.0f %% of what is allowed (S%zu of block %zu: %.6f, recorded %.6f)%s\n",
      name.c_str(), 100 * worst, where % 4, where / 4, now[where], means[where].get<double>(),
      fits ? "" : ": CHANGED");
  return fits;
}

int check(const std::filesystem::path& file, const std::filesystem::path& scenes,
          const std::string& name) {
  const json all = json::parse(std::ifstream(file));
  if (!all.contains(name)) {
    std::printf("%s: nothing is recorded of it\n", name.c_str());
    return 1;
  }
  double scale = all.at(name).at("scale");
  const json& integrators = all.at(name).at("integrators");
  bool fits = true;
  for (const std::string& integrator : guard::integrators()) {
    const auto now = guard::summarize(scenes / (name + ".xml"), integrator, checked_seed, scale);
    if (now.has_value() != integrators.contains(integrator)) {
      std::printf("%s: refused now or when it was recorded, but not both\n", integrator.c_str());
      fits = false;
    } else if (now) {
      fits &= check_integrator(integrators.at(integrator), integrator, *now);
    }
  }
  return fits ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> a(argv, argv + argc);
  try {
    if (a.size() == 4 && a[1] == "record") return record(a[2], a[3]);
    if (a.size() == 5 && a[1] == "check") return check(a[2], a[3], a[4]);
    std::fprintf(stderr, "usage: malus_guard record FILE SCENES | check FILE SCENES NAME\n");
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "malus_guard: %s\n", error.what());
    return 1;
  }
}
