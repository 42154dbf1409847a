// SPDX-License-Identifier: MIT
#include "render.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "../integrators/path.hpp"

namespace renderer {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr int tile_size = 16;
constexpr std::uint64_t samples_in_a_pass = 1 << 20;

/// Small films are split into batches of samples, so that every thread has work and the batches'
/// spread gives an error.
std::size_t batches_of(std::size_t pixels) { return std::clamp<std::size_t>(4096 / pixels, 1, 64); }

/// One pass over the film: sample numbers [first, last) of every pixel.
template <class R>
class Pass {
 public:
  Pass(const Scene& scene, const RenderOptions& options, Film& film)
      : scene_(scene),
        seed_(options.seed),
        film_(film),
        tiles_x_((film.width() + tile_size - 1) / tile_size),
        tiles_y_((film.height() + tile_size - 1) / tile_size),
        integrators_([&scene] { return PathIntegrator<R>(scene); }) {}

  /// False if it was stopped before its end; what is done stays done.
  bool run(std::uint64_t first, std::uint64_t last, const std::function<bool()>& stopped) {
    std::atomic<bool> complete{true};
    const auto tasks = static_cast<std::size_t>(tiles_x_ * tiles_y_) * film_.batches();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tasks, 1),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t task = range.begin(); task != range.end(); ++task) {
                          if (stopped()) {
                            complete = false;
                            return;
                          }
                          render_task(task, first, last);
                        }
                      });
    return complete;
  }

  Counters counters() const {
    Counters sum;
    for (const auto& integrator : integrators_) sum += integrator.counters();
    sum.samples = samples_;
    sum.non_finite = non_finite_;
    return sum;
  }

 private:
  void render_task(std::size_t task, std::uint64_t first, std::uint64_t last) {
    const std::size_t batches = film_.batches(), batch = task % batches;
    const int tile = static_cast<int>(task / batches);
    const std::uint64_t count = last - first;
    const std::uint64_t begin = first + count * batch / batches;
    const std::uint64_t end = first + count * (batch + 1) / batches;
    const int x0 = tile % tiles_x_ * tile_size, y0 = tile / tiles_x_ * tile_size;
    auto& integrator = integrators_.local();
    std::uint64_t dropped = 0, taken = 0;
    for (int y = y0; y < std::min(y0 + tile_size, film_.height()); ++y)
      for (int x = x0; x < std::min(x0 + tile_size, film_.width()); ++x)
        for (std::uint64_t sample = begin; sample < end; ++sample, ++taken)
          if (!render_sample(integrator, x, y, sample, batch)) ++dropped;
    samples_ += taken;
    non_finite_ += dropped;
  }

  /// False where the sample is not finite: it is dropped, and counted.
  bool render_sample(PathIntegrator<R>& integrator, int x, int y, std::uint64_t sample,
                     std::size_t batch) {
    const FilmSettings& f = scene_.film;
    const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(film_.width()) +
                       static_cast<std::size_t>(x);
    Sampler sampler(seed_, pixel, sample);
    const Vec2 place = Vec2(f.crop_x + x, f.crop_y + y) + 0.5f + f.filter.sample(sampler.next_2d());
    const Ray ray = scene_.sensor->ray(place / Vec2(f.width, f.height));
    const auto measured = integrator.measure(ray, sampler);
    for (std::size_t i = 0; i < 4; ++i)
      if (!malus::is_finite(measured[i])) return false;
    film_.at(pixel, batch).add(measured);
    return true;
  }

  const Scene& scene_;
  std::uint64_t seed_;
  Film& film_;
  int tiles_x_, tiles_y_;
  tbb::enumerable_thread_specific<PathIntegrator<R>> integrators_;
  std::atomic<std::uint64_t> samples_{0}, non_finite_{0};
};

template <class R>
Rendering render_as(const Scene& scene, const RenderOptions& options, const std::atomic<bool>& stop,
                    const std::function<void(const Progress&)>& report) {
  const int width = scene.film.crop_width, height = scene.film.crop_height;
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Rendering result{Film(width, height, batches_of(pixels)), {}, 0, 0, false};
  Pass<R> pass(scene, options, result.film);

  const std::uint64_t step = std::max<std::uint64_t>(1, samples_in_a_pass / pixels);
  const bool timed = options.seconds > 0;
  const auto start = Clock::now();
  const auto stopped = [&] {
    return stop.load(std::memory_order_relaxed) ||
           (timed && seconds_since(start) > options.seconds);
  };
  std::uint64_t done = 0;
  while (!stopped() && (timed || done < options.samples_per_pixel)) {
    const std::uint64_t next =
        timed ? done + step : std::min(done + step, options.samples_per_pixel);
    if (!pass.run(done, next, stopped)) break;
    done = next;
    if (!report) continue;
    const double seconds = seconds_since(start);
    const double fraction =
        timed ? seconds / options.seconds
              : static_cast<double>(done) / static_cast<double>(options.samples_per_pixel);
    report({std::min(fraction, 1.0), seconds, done, result.film.relative_noise()});
  }
  result.seconds = seconds_since(start);
  result.samples_per_pixel = done;
  result.counters = pass.counters();
  result.interrupted = stop;
  return result;
}

}  // namespace

Rendering render(const Scene& scene, const RenderOptions& options, const std::atomic<bool>& stop,
                 const std::function<void(const Progress&)>& report) {
  // More threads than processors are refused, with a message, unless they are allowed.
  std::optional<tbb::global_control> allowed;
  if (options.threads > 0)
    allowed.emplace(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(options.threads));
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  return arena.execute([&] {
    return options.mode == Mode::unpolarized
               ? render_as<malus::Unpolarized<Rgb>>(scene, options, stop, report)
               : render_as<malus::Polarized<Rgb>>(scene, options, stop, report);
  });
}

}  // namespace renderer
