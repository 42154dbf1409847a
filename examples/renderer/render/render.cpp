// SPDX-License-Identifier: MIT
#include "render.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "../integrators/scatterer.hpp"
#include "../io/input_error.hpp"
#include "checkpoint.hpp"

namespace renderer {

namespace {

template <class R>
std::unique_ptr<Passes> make_passes_by(const Scene& scene, const RenderOptions& options,
                                       Film& film) {
  return scene.has_media() ? make_passes_of<R, WithMedia>(scene, options, film)
                           : make_passes_of<R, NoMedia>(scene, options, film);
}

}  // namespace

std::unique_ptr<Passes> make_passes(const Scene& scene, const RenderOptions& options, Film& film) {
  return options.mode == Mode::unpolarized
             ? make_passes_by<malus::Unpolarized<Rgb>>(scene, options, film)
             : make_passes_by<malus::Polarized<Rgb>>(scene, options, film);
}

/// Sequences of a pixel help what its own paths find and connect. They do nothing for light that
/// comes to a pixel from all over the picture, nor for the long walks in media.
SamplerKind suited_sampler(const Scene& scene) {
  const std::string& integrator = scene.integrator.name;
  const bool connects = integrator == "path" || integrator == "bdpt" || integrator == "vcm";
  return connects && !scene.has_media() ? SamplerKind::sobol : SamplerKind::independent;
}

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

constexpr std::uint64_t samples_in_a_pass = 1 << 20;

/// Small films are split into batches of samples, so that every thread has work and the batches'
/// spread gives an error.
std::size_t batches_of(std::size_t pixels) { return std::clamp<std::size_t>(4096 / pixels, 1, 64); }

std::size_t pixels_of(const Scene& scene) {
  return static_cast<std::size_t>(scene.film.crop_width) *
         static_cast<std::size_t>(scene.film.crop_height);
}

/// The passes of one rendering, and what of them is kept for another run to go on from.
class Run {
 public:
  Run(const Scene& scene, const RenderOptions& options, const PassesMaker& make,
      const std::atomic<bool>& stop)
      : options_(options),
        stop_(stop),
        result_{Film(scene.film.crop_width, scene.film.crop_height,
                     options.batches > 0 ? options.batches : batches_of(pixels_of(scene)))},
        passes_(make(scene, options, result_.film)),
        step_(std::max<std::uint64_t>(1, samples_in_a_pass / pixels_of(scene))) {
    if (options.checkpoint != nullptr) resume();
  }

  /// Until the samples are taken, the time is up, or the user says so.
  Rendering finish(const std::function<void(const Progress&)>& report) {
    const std::function<bool()> stopped = [this] { return is_stopped(); };
    while (!stopped() && (is_timed() || done_ < options_.samples_per_pixel)) {
      const std::uint64_t last = next();
      const std::uint64_t first_sample = options_.first_sample;
      if (!passes_->run(first_sample + done_, first_sample + last, stopped)) {
        save(last);
        if (done_ == 0) passes_->salvage();
        return result();
      }
      unfinished_ = 0;
      done_ = last;
      if (report) report(progress());
      if (options_.checkpoint != nullptr && seconds_since(saved_) > options_.checkpoint->every())
        save(0);
    }
    save(0);  // the picture may yet fail to be written
    return result();
  }

 private:
  Rendering result() {
    result_.seconds = seconds();
    result_.samples_per_pixel = done_;
    result_.counters = counters();
    result_.light_vertices = passes_->light_vertices();
    result_.interrupted = stop_;
    return std::move(result_);
  }
  bool is_timed() const { return options_.seconds > 0; }
  double seconds() const { return before_.seconds + seconds_since(start_); }
  bool is_stopped() const {
    return stop_.load(std::memory_order_relaxed) ||
           ((done_ > 0 || !passes_->needs_whole_iterations()) && is_timed() &&
            seconds() > options_.seconds);
  }

  /// Where the next pass ends.
  std::uint64_t next() const {
    if (unfinished_ > 0) return unfinished_;
    const std::uint64_t end = passes_->next(done_, step_);
    return is_timed() ? end : std::min(end, options_.samples_per_pixel);
  }

  Counters counters() const {
    Counters sum = before_.counters;
    return sum += passes_->counters();
  }

  Progress progress() const {
    const double fraction =
        is_timed() ? seconds() / options_.seconds
                   : static_cast<double>(done_) / static_cast<double>(options_.samples_per_pixel);
    return {std::min(fraction, 1.0), seconds(), done_, result_.film.relative_noise()};
  }

  void resume() {
    if (!options_.checkpoint->load(before_, result_.film)) return;
    const std::uint64_t has = before_.finished.empty() ? before_.done : before_.last;
    if (!is_timed() && has > options_.samples_per_pixel)
      throw InputError({options_.checkpoint->path(), 0},
                       "is a checkpoint with " + std::to_string(has) +
                           " samples a pixel begun, more than the " +
                           std::to_string(options_.samples_per_pixel) + " that are asked for");
    done_ = before_.done;
    result_.resumed_from = done_;
    if (!before_.finished.empty()) unfinished_ = before_.last;
    if (!passes_->resume(before_.finished))
      throw InputError({options_.checkpoint->path(), 0}, "is a damaged checkpoint");
  }

  /// `last`: where the pass ends that has just been stopped, or 0.
  void save(std::uint64_t last) {
    if (options_.checkpoint == nullptr) return;
    options_.checkpoint->save({done_, last, passes_->finished(), seconds(), counters()},
                              result_.film);
    saved_ = std::chrono::steady_clock::now();
  }

  const RenderOptions& options_;
  const std::atomic<bool>& stop_;
  Rendering result_;
  std::unique_ptr<Passes> passes_;
  std::uint64_t step_;
  RenderState before_;            // what earlier runs did
  std::uint64_t done_ = 0;        // samples of every pixel, of all runs
  std::uint64_t unfinished_ = 0;  // where the pass ends that an earlier run has begun, or 0
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), saved_ = start_;
};

}  // namespace

Rendering render(const Scene& scene, const RenderOptions& options, const std::atomic<bool>& stop,
                 const std::function<void(const Progress&)>& report) {
  return render(scene, options, make_passes, stop, report);
}

Rendering render(const Scene& scene, const RenderOptions& options, const PassesMaker& make,
                 const std::atomic<bool>& stop,
                 const std::function<void(const Progress&)>& report) {
  // More threads than processors are refused, with a message, unless they are allowed.
  std::optional<tbb::global_control> allowed;
  if (options.threads > 0)
    allowed.emplace(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(options.threads));
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  return arena.execute([&] { return Run(scene, options, make, stop).finish(report); });
}

}  // namespace renderer
