// SPDX-License-Identifier: MIT
#include "measurement.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numeric>

namespace variants {

namespace {

double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double processor_seconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// One rendering, with all it keeps from one iteration to the next.
class Session {
 public:
  Session(const Contender& contender, const renderer::Scene& scene, bool of_processor)
      : film_(scene.film.crop_width, scene.film.crop_height, 1),
        passes_(contender.make(film_)),
        of_processor_(of_processor) {}

  /// The seconds that the next iterations take.
  double run(std::uint64_t iterations) {
    const std::uint64_t last = done_ + iterations;
    const double start = now();
    passes_->run(done_, last, [] { return false; });
    const double taken = now() - start;
    done_ = last;
    return taken;
  }
  const renderer::Passes& passes() const { return *passes_; }

 private:
  double now() const { return of_processor_ ? processor_seconds() : clock_seconds(); }

  renderer::Film film_;
  std::unique_ptr<renderer::Passes> passes_;
  bool of_processor_;
  std::uint64_t done_ = 0;
};

/// Who is in place k of a round of n: rounds are the rows of a square in which everyone is in every
/// place once and follows everyone else equally often (Williams 1949); of odd n, of that and of its
/// mirror image.
std::size_t who(std::size_t round, std::size_t k, std::size_t n) {
  if (n % 2 == 1 && round / n % 2 == 1) k = n - 1 - k;
  const std::size_t zigzag = k % 2 == 1 ? (k + 1) / 2 : (n - k / 2) % n;
  return (zigzag + round) % n;
}

}  // namespace

std::vector<Row> measure(const renderer::Scene& scene, const std::vector<Contender>& contenders,
                         double seconds, double turn, bool of_processor) {
  const std::size_t n = contenders.size();
  std::vector<std::unique_ptr<Session>> sessions;
  // The first iteration takes memory, and the second tells how long the others will take.
  double longest = 0;
  for (const Contender& c : contenders) {
    sessions.push_back(std::make_unique<Session>(c, scene, of_processor));
    sessions.back()->run(1);
    longest = std::max(longest, sessions.back()->run(1));
  }
  const auto iterations =
      static_cast<std::uint64_t>(std::max(1.0, std::floor(turn / std::max(longest, 1e-6))));

  std::vector<std::uint64_t> warm;  // samples that are not counted
  for (const auto& s : sessions) warm.push_back(s->passes().counters().samples);
  std::vector<std::vector<double>> taken(n);
  const double start = clock_seconds();
  for (std::size_t round = 0;
       round < least_pairs || clock_seconds() - start < seconds * static_cast<double>(n); ++round)
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = who(round, k, n);
      taken[i].push_back(sessions[i]->run(iterations));
    }

  std::vector<Row> rows(n);
  for (std::size_t i = 0; i < n; ++i) {
    Row& row = rows[i];
    const renderer::Passes& passes = sessions[i]->passes();
    row.variant = contenders[i].name;
    row.algorithm = scene.integrator.name;
    row.iterations = taken[i].size() * iterations;
    row.seconds = std::accumulate(taken[i].begin(), taken[i].end(), 0.0);
    const renderer::Counters counters = passes.counters();
    const auto paths = static_cast<double>(counters.samples);
    row.paths_per_second = (paths - static_cast<double>(warm[i])) / row.seconds;
    row.rays_per_path = static_cast<double>(counters.rays + counters.shadow_rays) / paths;
    row.merges_per_path = static_cast<double>(counters.merges) / paths;
    row.bytes_per_light_vertex = passes.light_vertices().bytes_per_vertex;
    if (i > 0) row.ratio = ratio_of(taken[0], taken[i]);
  }
  return rows;
}

}  // namespace variants
