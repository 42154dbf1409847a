// SPDX-License-Identifier: MIT
// Prints the tables of docs/forms.md: which form products and sums have, and what quantities take.
#include <malus/malus.hpp>

#include <cstdio>

namespace {

using namespace malus;

constexpr const char* mueller_names[] = {"zero",  "plain", "partial", "depol",
                                         "enter", "exit",  "block",   "full"};
constexpr const char* importance_names[] = {"zero", "plain", "depol", "full"};
constexpr const char* stokes_names[] = {"zero", "unpol", "full"};

struct Cell {
  const char* name;
  bool starred = false;  // holds only where the frames coincide
};

template <class Form, std::size_t N>
Cell cell(Form form, const char* const (&names)[N]) {
  return {names[static_cast<std::size_t>(form)]};
}
template <class Form, std::size_t N>
Cell cell(Form coincident, Form otherwise, const char* const (&names)[N]) {
  return {names[static_cast<std::size_t>(coincident)], coincident != otherwise};
}

template <std::size_t R, std::size_t C, class Entry>
void print_table(const char* corner, const char* const (&rows)[R], const char* const (&columns)[C],
                 Entry entry) {
  std::printf("| %s |", corner);
  for (const char* name : columns) std::printf(" **%s** |", name);
  std::printf("\n");
  for (std::size_t r = 0; r < R; ++r) {
    std::printf("| **%s** |", rows[r]);
    for (std::size_t c = 0; c < C; ++c) {
      const Cell at = entry(static_cast<int>(r), static_cast<int>(c));
      std::printf(" %s%s |", at.name, at.starred ? "\\*" : "");
    }
    std::printf("\n");
  }
}

void print_forms() {
  const auto m = [](int i) { return static_cast<MuellerForm>(i); };
  const auto s = [](int i) { return static_cast<StokesForm>(i); };
  const auto w = [](int i) { return static_cast<ImportanceForm>(i); };
  print_table("N \\\\ M", mueller_names, mueller_names, [&](int r, int c) {
    return cell(product_form(m(r), m(c), true), product_form(m(r), m(c), false), mueller_names);
  });
  print_table("M \\\\ S", mueller_names, stokes_names,
              [&](int r, int c) { return cell(product_form(m(r), s(c)), stokes_names); });
  print_table("w \\\\ M", stokes_names, mueller_names,
              [&](int r, int c) { return cell(row_product_form(s(r), m(c)), stokes_names); });
  print_table("W \\\\ M", importance_names, mueller_names,
              [&](int r, int c) { return cell(product_form(w(r), m(c)), importance_names); });
  print_table("M \\\\ N", mueller_names, mueller_names, [&](int r, int c) {
    return cell(sum_form(m(r), m(c), true), sum_form(m(r), m(c), false), mueller_names);
  });
  print_table("W \\\\ V", importance_names, importance_names, [&](int r, int c) {
    return cell(sum_form(w(r), w(c), true), sum_form(w(r), w(c), false), importance_names);
  });
}

struct Lab;
using InLab = StaticFrame<Lab>;

template <template <class> class Quantity>
void print_size(const char* name) {
  std::printf("| `%s` | %zu | %zu |\n", name, sizeof(Quantity<float>), sizeof(Quantity<Rgb>));
}

template <class V>
using Value = V;
template <class V>
using Light = Stokes<V>;
template <class V>
using Unpolarised = UnpolarizedStokes<V>;
template <class V>
using Row = Analyzer<V>;
template <class V>
using Readings = Measurement<V>;
template <class V>
using Matrix = Mueller<V>;
template <class V>
using Plain = PlainMueller<V>;
template <class V>
using Partial = PartialMueller<V>;
template <class V>
using Depolarizer = DepolarizingMueller<V>;
template <class V>
using Block = BlockMueller<V>;
template <class V>
using Full = FullMueller<V>;
template <class V>
using Rows = Importance<V>;
template <class V>
using LabLight = Stokes<V, exitant, InLab>;
template <class V>
using LabMatrix = Mueller<V, incident, exitant, InLab>;
template <class V>
using LabBlock = BlockMueller<V, incident, exitant, InLab>;

void print_sizes() {
  print_size<Value>("V");
  print_size<Light>("Stokes<V>");
  print_size<Unpolarised>("UnpolarizedStokes<V>");
  print_size<Row>("Analyzer<V>");
  print_size<Readings>("Measurement<V>");
  print_size<Matrix>("Mueller<V>");
  print_size<Plain>("PlainMueller<V>");
  print_size<Partial>("PartialMueller<V>");
  print_size<Depolarizer>("DepolarizingMueller<V>");
  print_size<Block>("BlockMueller<V>");
  print_size<Full>("FullMueller<V>");
  print_size<Rows>("Importance<V>");
  print_size<LabLight>("Stokes<V, exitant, StaticFrame<Lab>>");
  print_size<LabMatrix>("Mueller<V, incident, exitant, StaticFrame<Lab>>");
  print_size<LabBlock>("BlockMueller<V, incident, exitant, StaticFrame<Lab>>");
}

}  // namespace

int main() {
  print_forms();
  print_sizes();
}
