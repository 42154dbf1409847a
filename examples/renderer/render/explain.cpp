// SPDX-License-Identifier: MIT
#include "explain.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "../integrators/photon_map.hpp"

namespace renderer {

namespace {

using Kind = PolarizingElement::Kind;

std::string counted(std::size_t n, const std::string& noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

class Explanation {
 public:
  Explanation(const Scene& scene, const Needs& needs, const std::string& asked, Mode mode,
              const std::string& file)
      : scene_(scene), needs_(needs), asked_(asked), mode_(mode), file_(file) {}

  std::string text() {
    say(file_ + ", integrator \"" + scene_.integrator.name + "\", mode " + asked_);
    explain_mode();
    list_elements();
    explain_media();
    explain_passages();
    explain_directions();
    explain_storage();
    explain_lookups();
    return std::move(text_);
  }

 private:
  /// Elements of one BSDF or medium that fare alike.
  struct Group {
    const PolarizingElement* first;
    std::size_t count = 0, seen = 0;
  };

  void say(const std::string& sentence) { text_ += sentence + "\n"; }
  void begin(const std::string& title) { text_ += "\n" + title + "\n"; }

  std::string place(const Location& where) const {
    if (where.line <= 0) return "";
    return where.file == file_ ? " (line " + std::to_string(where.line) + ")"
                               : " (" + where.file + ":" + std::to_string(where.line) + ")";
  }
  std::string name(const Origin& o) const {
    return o.type + (o.id.empty() ? "" : " \"" + o.id + "\"") + place(o.where);
  }
  std::string material(const Bsdf* bsdf) const {
    const auto found = scene_.bsdf_origins.find(bsdf);
    return found == scene_.bsdf_origins.end() ? "default material" : name(found->second);
  }
  std::string shape(std::uint32_t number) const {
    return "the " + name(scene_.shape_origins[number]);
  }
  std::string medium(const PolarizingElement& e) const {
    return (e.kind == Kind::scattering ? "what is scattered in " : "extinction in ") +
           scene_.medium_names.at(e.medium);
  }
  std::string name(const PolarizingElement& e) const {
    return e.kind == Kind::surface ? shape(e.shape) : medium(e);
  }

  void explain_mode() {
    begin("Mode");
    const std::size_t all = needs_.elements.size(), matter = needs_.count_mattering();
    const bool with = mode_ == Mode::optimized;
    const std::string elements = counted(all, "element") + " that can polarise";
    const std::string some = matter < all ? std::to_string(matter) + " of " + elements + " matter"
                             : all > 1    ? "all of " + elements + " matter"
                                          : "what can polarise matters";
    if (with)
      say("Stokes vectors and Mueller matrices (optimized), " +
          (asked_ == "auto" ? "since " + some + "." : "as asked for: nothing is skipped."));
    else
      say("Intensities alone (unpolarized), " +
          (asked_ != "auto" ? std::string("as asked for.")
           : all == 0       ? std::string("since nothing polarises.")
           : all > 1
               ? "since none of " + elements + " matters: S1, S2 and S3 are 0."
               : std::string("since what can polarise doesn't matter: S1, S2 and S3 are 0.")));
    if (asked_ != "auto" && matter > 0 && !with)
      say("S0 differs from that of polarised light, and S1, S2 and S3 are missing: " +
          counted(matter, "element") + " that can polarise would matter.");
    if (asked_ != "auto" && matter == 0 && with)
      say("None of it is needed: \"auto\" would render intensities alone.");
  }

  std::vector<Group> groups() const {
    std::vector<Group> result;
    const auto key = [](const PolarizingElement& e) {
      return std::tuple(e.kind, e.bsdf, e.medium, e.matters);
    };
    for (const PolarizingElement& e : needs_.elements) {
      auto found = std::find_if(result.begin(), result.end(),
                                [&](const Group& g) { return key(*g.first) == key(e); });
      if (found == result.end()) found = result.insert(result.end(), Group{&e});
      ++found->count;
      if (e.is_seen) ++found->seen;
    }
    return result;
  }

  std::string subject(const Group& g) const {
    const PolarizingElement& e = *g.first;
    if (e.kind != Kind::surface) return medium(e);
    return material(e.bsdf) + " of " + (g.count == 1 ? shape(e.shape) : counted(g.count, "shape"));
  }

  std::string exchange(const Group& g) const {
    const PolarizingElement& e = *g.first;
    const std::string it = g.count == 1 ? "it" : "they";
    if (e.partner < 0) return "";
    const PolarizingElement& other = needs_.elements[static_cast<std::size_t>(e.partner)];
    if (g.count > 1 && other.bsdf && other.bsdf == e.bsdf)
      return it + " may exchange light with each other";
    return it + " may exchange light with " + (&other == &e ? "itself" : name(other));
  }

  std::string why_it_matters(const Group& g) const {
    if (needs_.is_too_large) return "there are too many to compare";
    std::string seen;
    if (g.seen > 0)
      seen = g.count == 1 ? "the sensor may see it"
                          : "the sensor may see " + (g.seen == g.count
                                                         ? std::string("them")
                                                         : std::to_string(g.seen) + " of them");
    const std::string exchanged = exchange(g);
    return seen + (seen.empty() || exchanged.empty() ? "" : ", and ") + exchanged;
  }

  std::string why_not(const Group& g) const {
    const PolarizingElement& e = *g.first;
    if (e.only_retards) return "it retards alone, and between nothing else that matters";
    std::string why = "neither the sensor nor anything else that polarises may see " +
                      std::string(g.count == 1 ? "it" : "them");
    if (e.is_cut_off)
      why += " on paths of at most " +
             counted(static_cast<std::size_t>(scene_.integrator.max_depth), "edge");
    return why;
  }

  void list_elements() {
    if (needs_.elements.empty() && needs_.idle.empty()) return;
    begin("What can polarise");
    for (const Group& g : groups())
      if (g.first->matters) say("- " + subject(g) + ": matters, since " + why_it_matters(g) + ".");
    for (const Group& g : groups())
      if (!g.first->matters)
        say("- " + subject(g) + ": " + fate(g) + ", since " + why_not(g) + ".");
    for (const IdleElement& e : needs_.idle)
      say("- " + material(e.bsdf) + " of " + shape(e.shape) + ": never counts, since it " +
          e.reason + ".");
  }

  std::string fate(const Group& g) const {
    if (asked_ != "auto" || mode_ == Mode::unpolarized) return "doesn't matter";
    return g.first->kind == Kind::extinction
               ? "doesn't matter, but stays, since distances are drawn by it"
               : "is skipped (a depolarizer of its m00)";
  }

  void explain_media() {
    begin("Media");
    if (!scene_.has_media()) return say("None: no code for media runs.");
    std::string names;
    for (const Medium& m : scene_.media)
      names += (names.empty() ? "" : ", ") + scene_.medium_names.at(&m);
    say("Distances are drawn in " + names + ".");
  }

  void explain_passages() {
    begin("Passages");
    const auto count = static_cast<std::size_t>(
        std::count_if(scene_.shapes.begin(), scene_.shapes.end(),
                      [](const Shape& s) { return s.material.lets_light_pass(); }));
    if (count == 0) return say("None: shadow rays end at the first surface.");
    say("Light may pass straight through " + counted(count, "shape") +
        " (sheets, masks, boundaries): shadow rays ask what they do to it.");
  }

  void explain_directions() {
    begin("Directions");
    if (mode_ == Mode::unpolarized)
      say("Drawn by m00: there is no polarisation to draw by.");
    else if (scene_.draws_by_polarization)
      say("Of what media scatter, drawn by the polarisation that a path carries: media here "
          "polarise what they scatter.");
    else
      say("Drawn by m00: no medium polarises what it scatters.");
  }

  template <class R, class M>
  void explain_storage_of(const Techniques& techniques) {
    const bool stores_stokes = R::polarized && (asked_ != "auto" || needs_.stored_polarization());
    say("A light vertex takes " + std::to_string(sizeof(LightVertex<R, M>)) + " bytes" +
        (techniques.merge
             ? ", a photon " + std::to_string(PhotonMap<R>::bytes_per_photon(stores_stokes))
             : "") +
        ".");
    if constexpr (R::polarized)
      say(stores_stokes
              ? "Its light is a Stokes vector: it may be polarised, and reach what polarises."
              : "Of its light the intensity alone is kept: what it is connected to or merged with "
                "depolarises.");
  }

  void explain_storage() {
    begin("Light paths");
    const auto techniques = Techniques::named(scene_.integrator.name);
    if (!techniques) return say("None are traced.");
    if (techniques->lens_alone) return say("None are stored.");
    const auto explain_as = [&]<class M>() {
      if (mode_ == Mode::unpolarized)
        explain_storage_of<malus::Unpolarized<Rgb>, M>(*techniques);
      else
        explain_storage_of<malus::Polarized<Rgb>, M>(*techniques);
    };
    scene_.has_media() ? explain_as.template operator()<WithMedia>()
                       : explain_as.template operator()<NoMedia>();
  }

  void explain_lookups() {
    begin("Surfaces");
    std::size_t uv = 0, tangent = 0, partials = 0;
    for (const Shape& s : scene_.shapes) {
      uv += s.material.needs.uv;
      tangent += s.material.needs.tangent;
      partials += s.material.needs.partials;
    }
    std::string what;
    const auto add = [&](std::size_t n, const std::string& noun) {
      if (n > 0) what += (what.empty() ? "" : ", ") + noun + " of " + counted(n, "shape");
    };
    add(uv, "texture coordinates");
    add(tangent, "axes");
    add(partials, "partial derivatives");
    say(what.empty() ? "Hits need a place and a normal alone."
                     : "Hits need a place and a normal, and " + what + " of " +
                           std::to_string(scene_.shapes.size()) + ".");
  }

  const Scene& scene_;
  const Needs& needs_;
  const std::string& asked_;
  const Mode mode_;
  const std::string& file_;
  std::string text_;
};

}  // namespace

std::string explanation(const Scene& scene, const Needs& needs, const std::string& asked, Mode mode,
                        const std::string& file) {
  return Explanation(scene, needs, asked, mode, file).text();
}

}  // namespace renderer
