// SPDX-License-Identifier: MIT
#include "merge.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <sstream>

#include "../io/input_error.hpp"

namespace renderer {
namespace {

/// Samples first … first + count − 1 of every pixel, under a seed.
struct SampleRange {
  std::uint64_t seed, first, count;
};

constexpr const char* samples_attribute = "malus:samples";

/// "SEED:FIRST+COUNT SEED:FIRST+COUNT …"
std::vector<SampleRange> parse_samples(const NamedImage& file) {
  const auto attribute = file.image.metadata.find(samples_attribute);
  if (attribute == file.image.metadata.end())
    throw InputError({file.name, 0},
                     std::string("has no ") + samples_attribute +
                         " in its header, which says how many samples a picture has; malus-render "
                         "and malus-merge write it");
  std::vector<SampleRange> ranges;
  std::istringstream words(attribute->second);
  for (std::string word; words >> word;) {
    SampleRange r{};
    const char* at = word.data();
    const char* const end = at + word.size();
    const auto number = [&](std::uint64_t& value, char after) {
      const auto [stop, error] = std::from_chars(at, end, value);
      const bool good =
          error == std::errc() && (after == '\0' ? stop == end : stop != end && *stop == after);
      at = good && after != '\0' ? stop + 1 : stop;
      return good;
    };
    if (!number(r.seed, ':') || !number(r.first, '+') || !number(r.count, '\0') ||
        r.count > std::uint64_t{1} << 50 || r.first > std::uint64_t{1} << 50)
      throw InputError({file.name, 0}, std::string(samples_attribute) + " in its header is \"" +
                                           attribute->second +
                                           "\"; allowed: SEED:FIRST+COUNT, any number of times");
    if (r.count > 0) ranges.push_back(r);
  }
  if (ranges.empty())
    throw InputError({file.name, 0},
                     "has no whole sample of every pixel: it was interrupted before");
  return ranges;
}

std::uint64_t count(const std::vector<SampleRange>& ranges) {
  std::uint64_t sum = 0;
  for (const SampleRange& r : ranges) sum += r.count;
  return sum;
}

bool overlap(const SampleRange& a, const SampleRange& b) {
  return a.seed == b.seed && a.first < b.first + b.count && b.first < a.first + a.count;
}

std::string attribute(const Image& image, const std::string& name) {
  const auto found = image.metadata.find(name);
  return found == image.metadata.end() ? "" : found->second;
}

/// What no number could make a sum of.
void check_same_form(const NamedImage& a, const NamedImage& b) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError({b.name, 0}, problem + ", other than " + a.name);
  };
  if (a.image.width != b.image.width || a.image.height != b.image.height)
    refuse("has " + std::to_string(b.image.width) + " x " + std::to_string(b.image.height) +
           " pixels");
  auto channels_a = a.image.channels, channels_b = b.image.channels;
  std::sort(channels_a.begin(), channels_a.end());
  std::sort(channels_b.begin(), channels_b.end());
  if (channels_a != channels_b) refuse("has other channels");
  const std::string frame = "malus:stokes_frame";
  if (attribute(a.image, frame) != attribute(b.image, frame))
    refuse("has Stokes vectors in the frame \"" + attribute(b.image, frame) + "\"");
}

void check_same_rendering(const NamedImage& a, const NamedImage& b) {
  for (const char* name : {"malus:scene", "malus:integrator", "malus:strategy", "malus:mode",
                           "malus:sampler", "malus:version"})
    if (attribute(a.image, name) != attribute(b.image, name))
      throw InputError({b.name, 0}, std::string(name) + " is \"" + attribute(b.image, name) +
                                        "\", and \"" + attribute(a.image, name) + "\" in " +
                                        a.name + "; --force merges them all the same");
}

void check_no_overlap(const NamedImage& a, const std::vector<SampleRange>& in_a,
                      const NamedImage& b, const std::vector<SampleRange>& in_b) {
  for (const SampleRange& r : in_a)
    for (const SampleRange& s : in_b)
      if (overlap(r, s))
        throw InputError({b.name, 0},
                         "has samples of seed " + std::to_string(s.seed) + " that are in " +
                             a.name + ", too: they count once; --force merges them all the same");
}

/// Neighbouring ranges become one, so that merging in steps writes what merging at once does.
std::string to_text(std::vector<SampleRange> ranges) {
  std::sort(ranges.begin(), ranges.end(), [](const SampleRange& a, const SampleRange& b) {
    return a.seed != b.seed ? a.seed < b.seed : a.first < b.first;
  });
  std::vector<SampleRange> joined;
  for (const SampleRange& r : ranges)
    if (!joined.empty() && joined.back().seed == r.seed &&
        joined.back().first + joined.back().count == r.first)
      joined.back().count += r.count;
    else
      joined.push_back(r);
  std::string text;
  for (const SampleRange& r : joined)
    text += (text.empty() ? "" : " ") + std::to_string(r.seed) + ":" + std::to_string(r.first) +
            "+" + std::to_string(r.count);
  return text;
}

std::string seeds(const std::vector<SampleRange>& ranges) {
  std::vector<std::uint64_t> all;
  for (const SampleRange& r : ranges) all.push_back(r.seed);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::string text;
  for (const std::uint64_t seed : all) text += (text.empty() ? "" : " ") + std::to_string(seed);
  return text;
}

/// Means add up by weight, and squares of the errors of independent means by its square.
void add_up(const std::vector<NamedImage>& files, const std::vector<double>& weights,
            Image& merged) {
  std::vector<double> sums(merged.pixels());
  for (const std::string& channel : merged.channels) {
    const bool is_error = channel.starts_with("SE");
    std::fill(sums.begin(), sums.end(), 0.0);
    for (std::size_t f = 0; f < files.size(); ++f) {
      const auto plane = files[f].image.plane(channel);
      for (std::size_t p = 0; p < plane.size(); ++p) {
        const double part = weights[f] * static_cast<double>(plane[p]);
        sums[p] += is_error ? part * part : part;
      }
    }
    const auto target = merged.plane(channel);
    for (std::size_t p = 0; p < target.size(); ++p)
      target[p] = static_cast<float>(is_error ? std::sqrt(sums[p]) : sums[p]);
  }
}

}  // namespace

Image merge_images(const std::vector<NamedImage>& files, bool force) {
  if (files.empty()) throw InputError("nothing to merge");
  std::vector<std::vector<SampleRange>> ranges;
  std::vector<SampleRange> all;
  for (const NamedImage& file : files) {
    check_same_form(files[0], file);
    if (!force) check_same_rendering(files[0], file);
    ranges.push_back(parse_samples(file));
    if (!force)
      for (std::size_t i = 0; i + 1 < ranges.size(); ++i)
        check_no_overlap(files[i], ranges[i], file, ranges.back());
    all.insert(all.end(), ranges.back().begin(), ranges.back().end());
  }
  std::vector<double> weights;
  for (const auto& r : ranges)
    weights.push_back(static_cast<double>(count(r)) / static_cast<double>(count(all)));
  Image merged(files[0].image.width, files[0].image.height, files[0].image.channels);
  merged.metadata = files[0].image.metadata;
  merged.metadata[samples_attribute] = to_text(all);
  merged.metadata["malus:samples_per_pixel"] = std::to_string(count(all));
  merged.metadata["malus:seed"] = seeds(all);
  add_up(files, weights, merged);
  return merged;
}

}  // namespace renderer
