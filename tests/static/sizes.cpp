// SPDX-License-Identifier: MIT
// What a quantity stores: the values of its form, run-time frames that the form needs, one byte for
// a flag; nothing else.
#include <type_traits>

#include <malus/malus.hpp>

namespace {

using namespace malus;

struct Lab;
struct Bench;
using InLab = StaticFrame<Lab>;

// Static frames and static forms take no storage, two equal frames in one matrix neither.
static_assert(sizeof(Stokes<float, exitant, InLab>) == 16);
static_assert(sizeof(Analyzer<float, exitant, InLab>) == 16);
static_assert(sizeof(Importance<float, exitant, InLab>) == 64);
static_assert(sizeof(Mueller<float, incident, exitant, InLab>) == 64);
static_assert(sizeof(Mueller<float, incident, exitant, InLab, StaticFrame<Bench>>) == 64);
static_assert(sizeof(Mueller<double, incident, exitant, InLab>) == 128);
static_assert(sizeof(Mueller<Rgb, incident, exitant, InLab>) == 16 * sizeof(Rgb));
static_assert(sizeof(Measurement<float>) == 16);

template <MuellerForm Form>
using OfForm = Mueller<float, incident, exitant, Frame<float>, Frame<float>, Form>;

// A form known at compile time stores its own values alone.
static_assert(sizeof(DepolarizingMueller<float>) == 4);
static_assert(sizeof(DepolarizingMueller<Rgb>) == 16);
static_assert(sizeof(PlainMueller<Rgb>) == 16);
static_assert(sizeof(PartialMueller<Rgb>) == 32);
static_assert(sizeof(UnpolarizedStokes<float>) == 4);
static_assert(sizeof(BlockMueller<float, incident, exitant, InLab>) == 32);
static_assert(sizeof(BlockMueller<float>) == 32 + 2 * sizeof(Frame<float>));
static_assert(sizeof(OfForm<MuellerForm::depolarizing_enter>) == 16 + sizeof(Frame<float>));
static_assert(sizeof(OfForm<MuellerForm::depolarizing_exit>) == 16 + sizeof(Frame<float>));
static_assert(sizeof(FullMueller<float>) == 64 + 2 * sizeof(Frame<float>));

// Flagged ones hold the largest form.
static_assert(sizeof(Frame<float>) == 24);
static_assert(sizeof(Stokes<float>) == 16 + 24 + 4);
static_assert(sizeof(Mueller<float>) == 64 + 2 * 24 + 4);
static_assert(sizeof(Rgb) == 16);
static_assert(sizeof(Spectrum<float, 16>) == 64);
static_assert(sizeof(Spectrum<double, 3>) == 32);

// What a renderer copies into arrays, photon maps and path records may be copied as bytes.
template <class Q>
constexpr bool is_plain_data =
    std::is_trivially_copyable_v<Q> && std::is_trivially_destructible_v<Q> &&
    std::is_standard_layout_v<Frame<typename Q::scalar_type>>;
static_assert(is_plain_data<Stokes<Rgb>>);
static_assert(is_plain_data<Analyzer<Rgb>>);
static_assert(is_plain_data<Mueller<Rgb>>);
static_assert(is_plain_data<BlockMueller<double>>);
static_assert(is_plain_data<Importance<Rgb>>);
static_assert(is_plain_data<Mueller<float, incident, exitant, InLab>>);
static_assert(std::is_trivially_copyable_v<Measurement<Rgb>>);
static_assert(std::is_trivially_copyable_v<Frame<float>>);
static_assert(std::is_trivially_copyable_v<Rgb> && std::is_trivially_default_constructible_v<Rgb>);
static_assert(std::is_trivially_default_constructible_v<Frame<float>>);
static_assert(std::is_empty_v<InLab>);

}  // namespace
