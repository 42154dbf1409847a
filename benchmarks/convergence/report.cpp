// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <cmath>
#include <cstdio>

namespace convergence {

namespace {

using Json = nlohmann::ordered_json;

/// Those of which tables have columns.
constexpr std::size_t shown[] = {0, polarization, degree};

/// The root of what may be below zero by chance.
double root(double square) { return square < 0 ? -std::sqrt(-square) : std::sqrt(square); }

/// Three digits, without an exponent where that is no longer.
std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value != 0 && std::abs(value) < 1e-4 ? "%.1e" : "%.3g", value);
  return text;
}

std::string error_text(const Point& p, std::size_t quantity, const Reference& reference) {
  const bool nothing = p.error(quantity) == 0 && reference.standard_error()[quantity] == 0;
  if (nothing) return "0";
  if (!p.resolved(quantity, reference)) return "(≤ reference's)";
  return digits(p.error(quantity)) + " ± " + digits(p.spread(quantity));
}

std::string slope_text(const std::optional<Line>& line) {
  if (!line) return "—";
  char text[48];
  std::snprintf(text, sizeof text, "%.2f ± %.2f", line->slope, line->slope_error);
  return text;
}

std::string time_text(const std::optional<TimeTo>& t) {
  if (!t) return "—";
  if (t->how == Found::at_most) return "≤ " + digits(t->seconds);
  char error[32];
  std::snprintf(error, sizeof error, " ± %.0f %%", 100 * t->error);
  return (t->how == Found::extrapolated ? "≈ " : "") + digits(t->seconds) + error;
}

const char* name_of(Found how) {
  switch (how) {
    case Found::measured:
      return "measured";
    case Found::at_most:
      return "at_most";
    default:
      return "extrapolated";
  }
}

Json by_quantity(auto&& value) {
  Json json;
  for (std::size_t q = 0; q < quantities; ++q) json[quantity_names[q]] = value(q);
  return json;
}

Json to_json(const Point& p, double seconds, const Reference& reference) {
  Json json;
  json["samples"] = p.samples;
  json["seconds"] = seconds;
  json["repeats"] = p.repeats.size();
  json["rmse"] = by_quantity([&](std::size_t q) { return p.error(q, false); });
  json["rmse_spread"] = by_quantity([&](std::size_t q) { return p.spread(q, false); });
  json["relative_error"] = by_quantity([&](std::size_t q) { return p.error(q); });
  json["relative_error_spread"] = by_quantity([&](std::size_t q) { return p.spread(q); });
  json["above_reference"] = by_quantity([&](std::size_t q) { return p.resolved(q, reference); });
  json["dop_bias"] = p.dop_bias();
  return json;
}

std::string gain_text(const std::optional<Gain>& gain) {
  if (!gain) return "—";
  return digits(gain->value) + " (" + digits(gain->low) + " to " + digits(gain->high) + ")";
}

/// Calls use(base, curve) for every curve of another sampler than the first.
void each_pair(const std::vector<Curve>& curves, const std::vector<std::string>& samplers,
               auto&& use) {
  for (const Curve& curve : curves)
    for (const Curve& base : curves)
      if (curve.sampler != samplers[0] && base.sampler == samplers[0] &&
          base.algorithm == curve.algorithm && base.variant == curve.variant)
        use(base, curve);
}

}  // namespace

void print_reference_head() {
  std::printf(
      "References, each the mean of two independent halves. Errors are relative, roots of means "
      "over pixels; the distance is that of the halves from each other beyond their noise.\n\n"
      "| scene | made by | samples a pixel | mean S0 | mean DoP | standard error of S0 | of S1–S3 "
      "| of DoP | distance² in S0 | in S1–S3 |\n"
      "|---|---|---|--:|--:|--:|--:|--:|--:|--:|\n");
}

void print(const SceneFile& file, const ReferencePlan& plan, const Reference& r) {
  const auto& error = r.standard_error();
  const auto distance = [&](std::size_t q) {
    return digits(r.distance()[q]) + " ± " + digits(r.distance_error()[q]);
  };
  std::printf("| %s | %s (weight %.2f), %s | %llu, %llu | %s | %s | %s | %s | %s | %s | %s |\n",
              file.name.c_str(), plan.recipes[0].text().c_str(), r.a().weight,
              plan.recipes[1].text().c_str(), static_cast<unsigned long long>(r.a().samples()),
              static_cast<unsigned long long>(r.b().samples()), digits(r.mean_intensity()).c_str(),
              digits(r.mean_degree()).c_str(), digits(error[0]).c_str(),
              digits(error[polarization]).c_str(), digits(error[degree]).c_str(),
              distance(0).c_str(), distance(polarization).c_str());
  std::fflush(stdout);
}

void print(const std::vector<Curve>& curves, const std::vector<double>& targets,
           const Reference& reference) {
  if (curves.empty()) return;
  std::printf(
      "\nErrors of the longest renderings, and the slopes of error over time.\n\n"
      "| scene | algorithm | variant | sampler | s | samples a pixel | S0 | S1–S3 | DoP | slope of "
      "S0 | of "
      "S1–S3 | of DoP |\n|---|---|---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const Curve& c : curves) {
    const Point& last = c.points.back();
    std::printf("| %s | %s | %s | %s | %s | %llu |", c.scene.c_str(), c.algorithm.c_str(),
                c.variant.c_str(), c.sampler.c_str(), digits(c.seconds(last)).c_str(),
                static_cast<unsigned long long>(last.samples));
    for (const std::size_t q : shown) std::printf(" %s |", error_text(last, q, reference).c_str());
    for (const std::size_t q : shown)
      std::printf(" %s |", slope_text(c.line(q, reference)).c_str());
    std::printf("\n");
  }
  std::printf("\nSeconds to a relative error.\n\n| scene | algorithm | variant | sampler |");
  for (const std::size_t q : shown)
    for (const double t : targets) std::printf(" %s to %g |", quantity_names[q], t);
  std::printf("\n|---|---|---|---|");
  for (std::size_t i = 0; i < std::size(shown) * targets.size(); ++i) std::printf("--:|");
  for (const Curve& c : curves) {
    std::printf("\n| %s | %s | %s | %s |", c.scene.c_str(), c.algorithm.c_str(), c.variant.c_str(),
                c.sampler.c_str());
    for (const std::size_t q : shown)
      for (const double t : targets)
        std::printf(" %s |", time_text(c.time_to(t, q, reference)).c_str());
  }
  std::printf("\n");
  std::fflush(stdout);
}

void print_gains(const std::vector<Curve>& curves, const std::vector<std::string>& samplers,
                 const Reference& reference) {
  if (samplers.size() < 2) return;
  std::printf(
      "\nHow many times smaller squared errors are than with the sampler \"%s\" (95 %%).\n\n"
      "| scene | algorithm | variant | sampler | samples a pixel | S0, equal samples | S0, equal "
      "time | S1–S3, equal samples | S1–S3, equal time |\n|---|---|---|---|--:|--:|--:|--:|--:|\n",
      samplers[0].c_str());
  each_pair(curves, samplers, [&](const Curve& base, const Curve& c) {
    std::printf("| %s | %s | %s | %s |", c.scene.c_str(), c.algorithm.c_str(), c.variant.c_str(),
                c.sampler.c_str());
    const auto at = gain_over(base, c, 0, false, reference);
    std::printf(" %s |", at ? std::to_string(at->samples).c_str() : "—");
    for (const std::size_t q : {std::size_t{0}, polarization})
      for (const bool at_equal_time : {false, true})
        std::printf(" %s |", gain_text(gain_over(base, c, q, at_equal_time, reference)).c_str());
    std::printf("\n");
  });
  std::fflush(stdout);
}

Json gains_to_json(const std::vector<Curve>& curves, const std::vector<std::string>& samplers,
                   const Reference& reference) {
  Json list = Json::array();
  each_pair(curves, samplers, [&](const Curve& base, const Curve& c) {
    for (std::size_t q = 0; q < quantities; ++q)
      for (const bool at_equal_time : {false, true})
        if (const auto g = gain_over(base, c, q, at_equal_time, reference))
          list.push_back({{"scene", c.scene},
                          {"algorithm", c.algorithm},
                          {"variant", c.variant},
                          {"sampler", c.sampler},
                          {"over", base.sampler},
                          {"quantity", quantity_names[q]},
                          {"at_equal", at_equal_time ? "time" : "samples"},
                          {"samples", g->samples},
                          {"ratio", g->value},
                          {"ratio_low", g->low},
                          {"ratio_high", g->high}});
  });
  return list;
}

Json to_json(const SceneFile& file, const ReferencePlan& plan, const Reference& r) {
  const auto half = [&](const Half& h, std::size_t which) {
    return Json{{"recipe", plan.recipes[which].text()},
                {"weight", h.weight},
                {"batches", h.batches.size()},
                {"samples", h.samples()},
                {"seconds", h.seconds()}};
  };
  Json json{{"scene", file.name},
            {"width", r.a().batches[0].width},
            {"height", r.a().batches[0].height},
            {"halves", Json::array({half(r.a(), 0), half(r.b(), 1)})},
            {"mean_s0", r.mean_intensity()},
            {"mean_dop", r.mean_degree()}};
  json["standard_error"] = by_quantity([&](std::size_t q) { return r.standard_error()[q]; });
  // Of the degree of polarisation there is none.
  json["distance"] = Json::object();
  for (std::size_t q = 0; q < degree; ++q)
    json["distance"][quantity_names[q]] = {
        {"square", r.distance()[q]},
        {"standard_error", r.distance_error()[q]},
        {"root", root(r.distance()[q])},
    };
  return json;
}

Json to_json(const Curve& c, const std::vector<double>& targets, const Reference& reference) {
  Json json{{"scene", c.scene},        {"algorithm", c.algorithm}, {"variant", c.variant},
            {"sampler", c.sampler},    {"mode", c.mode},           {"drawn_by", c.drawn_by},
            {"points", Json::array()}, {"slopes", Json::object()}, {"time_to", Json::array()}};
  for (const Point& p : c.points) json["points"].push_back(to_json(p, c.seconds(p), reference));
  for (std::size_t q = 0; q < quantities; ++q) {
    const auto line = c.line(q, reference);
    json["slopes"][quantity_names[q]] = line ? Json{{"slope", line->slope},
                                                    {"standard_error", line->slope_error},
                                                    {"error_at_1_s", std::exp(line->intercept)}}
                                             : Json(nullptr);
    for (const double target : targets)
      if (const auto t = c.time_to(target, q, reference))
        json["time_to"].push_back({{"quantity", quantity_names[q]},
                                   {"error", target},
                                   {"seconds", t->seconds},
                                   {"how", name_of(t->how)},
                                   {"relative_standard_error", t->error}});
  }
  return json;
}

}  // namespace convergence
