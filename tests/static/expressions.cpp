// SPDX-License-Identifier: MIT
// Which expressions compile, and of what type their results are. That the wrong ones fail for the
// stated reason is for the tests in compile_fail/.
#include <concepts>
#include <functional>

#include <malus/malus.hpp>

namespace {

using namespace malus;

template <class A, class B>
concept Multiplies = requires(const A& a, const B& b) { a* b; };
template <class A, class B>
concept Adds = requires(const A& a, const B& b) { a + b; };
template <class A, class B>
concept Accumulates = requires(A& a, const B& b) { a += b; };
template <class A, class B>
concept MultipliesInPlace = requires(A& a, const B& b) { a *= b; };
template <class A, class B>
concept Compares = requires(const A& a, const B& b) { a == b; };
template <class A, class B>
concept HasInnerProduct = requires(const A& a, const B& b) { inner_product(a, b); };
template <class A>
concept Propagates = requires(const A& a) { propagate(a); };
template <class A, class T>
concept PropagatesThrough = requires(const A& a, const T& t) { propagate(a, t); };

template <class A, class B>
using Product = decltype(std::declval<A>() * std::declval<B>());
template <class A, class B>
using Sum = decltype(std::declval<A>() + std::declval<B>());

using Arriving = Stokes<Rgb, incident>;
using Leaving = Stokes<Rgb, exitant>;
using Bsdf = Mueller<Rgb, incident, exitant>;
using Transmittance = Mueller<Rgb, exitant, incident>;
using Scattered = Mueller<Rgb, incident, incident>;  // a BSDF and the way to the next vertex
using OfArriving = Importance<Rgb, incident>;
using OfLeaving = Importance<Rgb, exitant>;
using RowOfArriving = Analyzer<Rgb, incident>;
using RowOfLeaving = Analyzer<Rgb, exitant>;
using Readings = Measurement<Rgb>;

// Light and matrices
static_assert(std::same_as<Product<Bsdf, Arriving>, Leaving>);
static_assert(std::same_as<Product<Transmittance, Leaving>, Arriving>);
static_assert(std::same_as<Product<Bsdf, Scattered>, Bsdf>);
static_assert(std::same_as<Product<Transmittance, Bsdf>, Scattered>);
static_assert(!Multiplies<Bsdf, Leaving>, "propagate first");
static_assert(!Multiplies<Transmittance, Arriving>, "already propagated");
static_assert(!Multiplies<Bsdf, Bsdf>, "propagate first");
static_assert(!Multiplies<Transmittance, Transmittance>);
static_assert(!Multiplies<Arriving, Bsdf>, "the matrix stands on the left");
static_assert(!Multiplies<Leaving, Bsdf>);
static_assert(!Multiplies<Leaving, Leaving>, "inner_product");
static_assert(!Multiplies<Arriving, Leaving>);

// Measuring
static_assert(std::same_as<Product<OfLeaving, Bsdf>, OfArriving>);
static_assert(std::same_as<Product<OfArriving, Transmittance>, OfLeaving>);
static_assert(std::same_as<Product<OfArriving, Arriving>, Readings>);
static_assert(std::same_as<Product<RowOfLeaving, Bsdf>, RowOfArriving>);
static_assert(std::same_as<Product<RowOfArriving, Arriving>, Rgb>);
static_assert(!Multiplies<OfArriving, Bsdf>, "propagate first");
static_assert(!Multiplies<RowOfArriving, Bsdf>);
static_assert(!Multiplies<OfArriving, Leaving>);
static_assert(!Multiplies<OfLeaving, Arriving>);
static_assert(!Multiplies<RowOfLeaving, Arriving>);
static_assert(!Multiplies<Bsdf, OfLeaving>, "importance stands on the left");
static_assert(!Multiplies<Bsdf, OfArriving>);
static_assert(!Multiplies<Leaving, OfLeaving>);
static_assert(!Multiplies<Leaving, RowOfLeaving>);
static_assert(!Multiplies<Bsdf, RowOfLeaving>);
static_assert(!Multiplies<OfLeaving, OfLeaving>);
static_assert(!Multiplies<RowOfLeaving, RowOfLeaving>);
static_assert(!Multiplies<OfLeaving, RowOfLeaving>);
static_assert(!Multiplies<Readings, Bsdf> && !Multiplies<Bsdf, Readings>);
static_assert(!Multiplies<Readings, Leaving> && !Multiplies<Leaving, Readings>);
static_assert(!Multiplies<Readings, OfLeaving> && !Multiplies<OfLeaving, Readings>);
static_assert(!Multiplies<Readings, Readings>);

// Sums
static_assert(std::same_as<Sum<Leaving, Leaving>, Leaving>);
static_assert(std::same_as<Sum<Bsdf, Bsdf>, Bsdf>);
static_assert(std::same_as<Sum<OfLeaving, OfLeaving>, OfLeaving>);
static_assert(std::same_as<Sum<RowOfLeaving, RowOfLeaving>, RowOfLeaving>);
static_assert(std::same_as<Sum<Readings, Readings>, Readings>);
static_assert(Accumulates<Leaving, Leaving> && Accumulates<Bsdf, Bsdf> &&
              Accumulates<OfLeaving, OfLeaving> && Accumulates<Readings, Readings>);
static_assert(!Adds<Leaving, Arriving> && !Accumulates<Leaving, Arriving>);
static_assert(!Adds<Bsdf, Transmittance> && !Adds<Bsdf, Scattered>);
static_assert(!Adds<OfLeaving, OfArriving> && !Adds<RowOfLeaving, RowOfArriving>);
static_assert(!Adds<Readings, Leaving> && !Adds<Leaving, Readings>);
static_assert(!Accumulates<Leaving, Readings> && !Accumulates<Readings, Leaving>);
static_assert(!Adds<Leaving, Bsdf> && !Adds<Bsdf, Leaving> && !Accumulates<Leaving, Bsdf>);
static_assert(!Adds<OfLeaving, Bsdf> && !Adds<OfLeaving, RowOfLeaving> &&
              !Adds<OfLeaving, Leaving>);
static_assert(!Adds<RowOfLeaving, Leaving>);
static_assert(!Adds<Leaving, Rgb> && !Adds<Leaving, float> && !Adds<Bsdf, float>);

// Scaling
static_assert(std::same_as<Product<Rgb, Leaving>, Leaving> &&
              std::same_as<Product<Leaving, Rgb>, Leaving>);
static_assert(std::same_as<Product<float, Bsdf>, Bsdf> && std::same_as<Product<Bsdf, float>, Bsdf>);
static_assert(std::same_as<Product<float, OfLeaving>, OfLeaving>);
static_assert(std::same_as<Product<RowOfLeaving, Rgb>, RowOfLeaving>);
static_assert(std::same_as<Product<float, Readings>, Readings>);
static_assert(MultipliesInPlace<Leaving, Rgb> && MultipliesInPlace<Bsdf, float> &&
              MultipliesInPlace<Readings, Rgb>);
static_assert(!MultipliesInPlace<Leaving, Leaving> && !MultipliesInPlace<Leaving, Bsdf>);
static_assert(!MultipliesInPlace<RowOfArriving, Arriving>, "a reading is no analyzer");
static_assert(!MultipliesInPlace<OfArriving, Arriving>);
static_assert(!MultipliesInPlace<Bsdf, Arriving>);

// Propagation
static_assert(std::same_as<decltype(propagate(Leaving())), Arriving>);
static_assert(std::same_as<decltype(propagate(Bsdf())), Scattered>);
static_assert(std::same_as<decltype(propagate(OfArriving())), OfLeaving>);
static_assert(std::same_as<decltype(propagate(RowOfArriving())), RowOfLeaving>);
static_assert(!Propagates<Arriving> && !Propagates<Scattered> && !Propagates<OfLeaving> &&
              !Propagates<RowOfLeaving> && !Propagates<Readings>);
static_assert(std::same_as<decltype(propagate(Leaving(), Transmittance())), Arriving>);
static_assert(std::same_as<decltype(propagate(Bsdf(), Transmittance())), Scattered>);
static_assert(std::same_as<decltype(propagate(OfArriving(), Transmittance())), OfLeaving>);
static_assert(std::same_as<decltype(propagate(RowOfArriving(), Transmittance())), RowOfLeaving>);
static_assert(!PropagatesThrough<Arriving, Transmittance> &&
              !PropagatesThrough<OfLeaving, Transmittance>);
static_assert(!PropagatesThrough<Leaving, Bsdf>, "a BSDF is no transmittance");

// The loops of a path tracer keep their types
static_assert(std::same_as<Product<Bsdf, decltype(propagate(Leaving()))>, Leaving>);
static_assert(std::same_as<Product<decltype(propagate(OfArriving())), Bsdf>, OfArriving>);

// The adjoint
template <MuellerForm Form, class In, class Out>
using OfForm = Mueller<float, In, Out, Frame<float>, Frame<float>, Form>;
static_assert(std::same_as<decltype(adjoint(Bsdf())), Transmittance>);
static_assert(
    std::same_as<decltype(adjoint(OfForm<MuellerForm::depolarizing_enter, incident, exitant>())),
                 OfForm<MuellerForm::depolarizing_exit, exitant, incident>>);

// Inner product and equality
static_assert(HasInnerProduct<Leaving, Leaving> && !HasInnerProduct<Leaving, Arriving>);
static_assert(!HasInnerProduct<Leaving, Stokes<float>> && !HasInnerProduct<Leaving, OfLeaving>);
static_assert(Compares<Leaving, Leaving> && Compares<Bsdf, Bsdf> &&
              Compares<OfLeaving, OfLeaving> && Compares<Readings, Readings>);
static_assert(Compares<Bsdf, BlockMueller<Rgb>>, "forms need not agree");
static_assert(!Compares<Leaving, Arriving> && !Compares<Leaving, Bsdf> &&
              !Compares<Leaving, Readings>);

// Values
static_assert(!Multiplies<Mueller<float>, Stokes<double, incident>>);
static_assert(!Multiplies<Bsdf, Stokes<float, incident>>);
static_assert(!Adds<Stokes<float>, Stokes<double>>);
static_assert(!Adds<Stokes<Spectrum<float, 4>>, Stokes<Spectrum<float, 8>>>);

// Static frames
struct Lab;
struct Bench;
using InLab = StaticFrame<Lab>;
using OnBench = StaticFrame<Bench>;
using LabLight = Stokes<float, exitant, InLab>;
using BenchLight = Stokes<float, exitant, OnBench>;
using LabElement = Mueller<float, exitant, exitant, InLab>;
using LabToBench = Mueller<float, exitant, exitant, InLab, OnBench>;
using LabReader = Importance<float, exitant, InLab>;

static_assert(std::same_as<Product<LabElement, LabLight>, LabLight>);
static_assert(std::same_as<Product<LabToBench, LabLight>, BenchLight>);
static_assert(std::same_as<Product<LabToBench, LabElement>, LabToBench>);
static_assert(!Multiplies<LabElement, LabToBench> && !Multiplies<LabElement, BenchLight>);
static_assert(!Multiplies<LabReader, BenchLight> && Multiplies<LabReader, LabLight>);
static_assert(!Adds<LabLight, BenchLight> && !Adds<LabElement, LabToBench>);
static_assert(!HasInnerProduct<LabLight, BenchLight>);
static_assert(!Multiplies<LabElement, Stokes<float, exitant>>, "static meets run-time");
static_assert(!Adds<LabLight, Stokes<float, exitant>>);
static_assert(!Multiplies<Mueller<float, exitant, exitant>, LabLight>);

// A block between equal static frames stays a block, by type.
template <MuellerForm Form>
using Static = Mueller<float, exitant, exitant, InLab, InLab, Form>;
static_assert(std::same_as<Product<Static<MuellerForm::block>, Static<MuellerForm::block>>,
                           Static<MuellerForm::block>>);
static_assert(std::same_as<Sum<Static<MuellerForm::block>, Static<MuellerForm::plain>>,
                           Static<MuellerForm::block>>);
static_assert(Product<BlockMueller<float, exitant, exitant>,
                      BlockMueller<float, exitant, exitant>>::static_form == MuellerForm::full);

// No GLM type is an argument of these classes: its operators would join every look-up
static_assert(!Multiplies<Bsdf, glm::mat4> && !Multiplies<glm::mat4, Leaving> &&
              !Adds<Leaving, glm::vec4>);

// Nothing converts by itself
static_assert(!std::convertible_to<Leaving, Arriving> && !std::convertible_to<Arriving, Leaving>);
static_assert(!std::convertible_to<Bsdf, Transmittance> && !std::convertible_to<Readings, Leaving>);
static_assert(!std::convertible_to<Leaving, Readings> && !std::convertible_to<Rgb, Leaving>);
static_assert(!std::convertible_to<LabLight, BenchLight>);
static_assert(!std::convertible_to<Bsdf, BlockMueller<Rgb>>, "a flag may say otherwise");
static_assert(std::convertible_to<BlockMueller<Rgb>, Bsdf> &&
              std::convertible_to<UnpolarizedStokes<Rgb>, Leaving>);
static_assert(!std::convertible_to<float, Rgb>, "one value for every channel is said, not guessed");

}  // namespace
