// SPDX-License-Identifier: MIT
#include "rendering.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <optional>

#include "io/exr.hpp"
#include "io/input_error.hpp"

namespace convergence {

namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::string hexadecimal(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

const std::vector<std::string>& channel_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const char* s : {"S0", "S1", "S2", "S3"})
      for (const char* c : {".R", ".G", ".B"}) list.push_back(std::string(s) + c);
    return list;
  }();
  return names;
}

/// What a cached picture says about itself.
constexpr const char *scene_key = "malus:scene_hash", *recipe_key = "malus:recipe",
                     *seed_key = "malus:seed", *samples_key = "malus:samples_per_pixel",
                     *asked_key = "malus:seconds_asked_for", *seconds_key = "malus:seconds",
                     *frame_key = "malus:stokes_frame";

double number(const renderer::Image& image, const char* key) {
  const auto found = image.metadata.find(key);
  double value = 0;
  if (found == image.metadata.end()) return 0;
  const std::string& text = found->second;
  return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc() ? value
                                                                                          : 0;
}

void store(const std::string& path, const Picture& p, std::map<std::string, std::string> facts) {
  renderer::Image image(p.width, p.height, channel_names());
  image.data = p.data;
  facts[samples_key] = std::to_string(p.samples);
  facts[seconds_key] = std::to_string(p.seconds);
  facts[frame_key] = "horizontal";
  image.metadata = std::move(facts);
  renderer::write_exr(path, image);
}

/// A cached picture, if it is there and is what it has to be.
std::optional<Picture> fetch(const std::string& path,
                             const std::map<std::string, std::string>& facts, double seconds) {
  if (!std::filesystem::exists(path)) return {};
  const renderer::Image image = renderer::read_exr(path);
  for (const auto& [key, value] : facts) {
    const auto found = image.metadata.find(key);
    if (key != asked_key && (found == image.metadata.end() || found->second != value)) return {};
  }
  if (number(image, asked_key) < seconds * 0.999) return {};
  Picture p{image.width, image.height, {}, 0, number(image, seconds_key)};
  p.samples = static_cast<std::uint64_t>(number(image, samples_key));
  for (const auto& name : channel_names()) {
    if (!image.has(name)) return {};
    const auto plane = image.plane(name);
    p.data.insert(p.data.end(), plane.begin(), plane.end());
  }
  return p;
}

Half make_half(const SceneFile& file, const ReferencePlan& plan, std::size_t which) {
  const Recipe& recipe = plan.recipes[which];
  const double seconds = plan.seconds / static_cast<double>(plan.batches);
  std::optional<renderer::Scene> scene;
  Half half;
  Job job;
  job.threads = plan.threads;
  for (std::size_t k = 0; k < plan.batches; ++k) {
    // Far from the seeds of what is measured; two halves may be of one recipe.
    job.seed = (std::uint64_t{1} << 40) + which * (std::uint64_t{1} << 32) + k;
    std::map<std::string, std::string> facts{{scene_key, hexadecimal(file.hash)},
                                             {recipe_key, recipe.text()},
                                             {seed_key, std::to_string(job.seed)},
                                             {asked_key, std::to_string(seconds)}};
    const auto path =
        (plan.cache / (file.name + "-" + hexadecimal(file.hash).substr(0, 8) + "-" + recipe.text() +
                       "-" + std::to_string(which) + "-" + std::to_string(k) + ".exr"))
            .string();
    if (auto cached = fetch(path, facts, seconds);
        cached && (k == 0 || cached->samples == half.batches[0].samples)) {
      half.batches.push_back(std::move(*cached));
      continue;
    }
    if (!scene) scene.emplace(load(file, recipe.algorithm, recipe.radius_factor));
    job.samples = k == 0 ? samples_for(*scene, seconds, job) : half.batches[0].samples;
    half.batches.push_back(render(*scene, job));
    store(path, half.batches.back(), std::move(facts));
  }
  return half;
}

}  // namespace

Picture render(const renderer::Scene& scene, const Job& job) {
  renderer::RenderOptions options;
  options.samples_per_pixel = job.samples;
  options.seed = job.seed;
  options.sampler = job.sampler;
  options.threads = job.threads;
  options.batches = 1;
  const std::atomic<bool> stop{false};
  const double before = processor_seconds();
  const renderer::Rendering r = renderer::render(
      scene, options, std::bind_front(variants::make_passes, job.variant), stop, {});
  const double used = processor_seconds() - before;

  Picture p{r.film.width(), r.film.height(), {}, job.samples, job.threads == 1 ? used : r.seconds};
  p.data.resize(planes * p.pixels());
  for (std::size_t pixel = 0; pixel < p.pixels(); ++pixel) {
    const renderer::PixelSum total = r.film.total(pixel);
    for (std::size_t i = 0; i < planes; ++i)
      p.data[i * p.pixels() + pixel] = static_cast<float>(total.mean(i));
  }
  return p;
}

std::uint64_t samples_for(const renderer::Scene& scene, double seconds, Job job) {
  for (job.samples = 1;; job.samples *= 2) {
    const double taken = render(scene, job).seconds;
    if (taken < seconds / 4 && job.samples < (1u << 30)) continue;
    const double samples = static_cast<double>(job.samples) * seconds / std::max(taken, 1e-9);
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::lround(samples)));
  }
}

Recipe Recipe::parse(const std::string& text) {
  Recipe recipe;
  const auto colon = text.find(':');
  recipe.algorithm = text.substr(0, colon);
  bool good = true;
  if (colon != std::string::npos) {
    const char *begin = text.data() + colon + 1, *end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, recipe.radius_factor);
    good = error == std::errc() && stop == end && recipe.radius_factor > 0 &&
           recipe.radius_factor <= 1000;
  }
  for (const char* name : {"path", "ptracer", "bdpt", "ppm", "bpm", "vcm"})
    if (good && recipe.algorithm == name) return recipe;
  throw renderer::InputError("--reference " + text +
                             ": expected path, ptracer, bdpt, ppm, bpm or vcm, after which may "
                             "stand a factor of merges' radii, as in vcm:0.25");
}

std::string Recipe::text() const {
  if (radius_factor == 1) return algorithm;
  char number[32];
  std::snprintf(number, sizeof number, ":%.6g", radius_factor);
  return algorithm + number;
}

Reference make_reference(const SceneFile& file, const ReferencePlan& plan) {
  std::error_code error;
  std::filesystem::create_directories(plan.cache, error);
  if (error) throw renderer::InputError("--cache " + plan.cache.string() + ": " + error.message());
  Half a = make_half(file, plan, 0), b = make_half(file, plan, 1);
  return {std::move(a), std::move(b)};
}

}  // namespace convergence
