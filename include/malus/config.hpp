// SPDX-License-Identifier: MIT
// Version, compiler portability, and the hook that reports frames whose directions disagree.
//
// The types catch a wrong order and a missing propagation; they cannot catch a wrong axis or two
// vertices mixed up. With MALUS_CHECK_FRAMES (on unless NDEBUG is defined) every operation on
// run-time frames checks that both describe light of one direction, and calls the handler with both
// frames where they don't.
#pragma once

#include <cstdio>
#include <cstdlib>

#define MALUS_VERSION_MAJOR 0
#define MALUS_VERSION_MINOR 1
#define MALUS_VERSION_PATCH 0

/// 1: operations check that run-time frames agree in direction. Give it the same value in a whole
/// program.
#if !defined(MALUS_CHECK_FRAMES)
#if defined(NDEBUG)
#define MALUS_CHECK_FRAMES 0
#else
#define MALUS_CHECK_FRAMES 1
#endif
#endif

/// 1: small operations are inlined even where a compiler would rather call them, which fast code
/// needs and slow code takes several times as long to compile for. By default where compilers
/// optimise; 0 suits sanitizers.
#if !defined(MALUS_FORCE_INLINE)
#if defined(__OPTIMIZE__) || (defined(_MSC_VER) && !defined(_DEBUG))
#define MALUS_FORCE_INLINE 1
#else
#define MALUS_FORCE_INLINE 0
#endif
#endif

// MALUS_INLINE_LAMBDA is MALUS_INLINE for a lambda, after its parameters.
#if !MALUS_FORCE_INLINE
#define MALUS_INLINE inline
#define MALUS_INLINE_LAMBDA
#elif defined(_MSC_VER) && !defined(__clang__)
#define MALUS_INLINE __forceinline
#define MALUS_INLINE_LAMBDA
#else
#define MALUS_INLINE inline __attribute__((always_inline))
#define MALUS_INLINE_LAMBDA __attribute__((always_inline))
#endif

#if defined(_MSC_VER) && !defined(__clang__)
#define MALUS_NO_UNIQUE_ADDRESS [[msvc::no_unique_address]]
#else
#define MALUS_NO_UNIQUE_ADDRESS [[no_unique_address]]
#endif

/// 1: the values of a Spectrum lie in vector types of GNU's compilers, which Clang has, too. 0: in
/// arrays of the same size and alignment, as for any other compiler; the same operations, slower.
#if !defined(MALUS_SIMD)
#if defined(__GNUC__) || defined(__clang__)
#define MALUS_SIMD 1
#else
#define MALUS_SIMD 0
#endif
#endif

// g++ 12 with AVX-512 moves a constant whose upper part is zero as a broadcast of its lower part:
// (a, a, a, a, 0, 0, 0, 0) arrives as eight times a. There, makers hide what they store from the
// optimiser (detail::hide_constant). -fno-tree-slp-vectorize avoids it in other code.
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ == 12 && defined(__AVX512F__)
#define MALUS_HIDE_CONSTANTS 1
#else
#define MALUS_HIDE_CONSTANTS 0
#endif

// -ffast-math is allowed, and loses what the message says; docs/accuracy.md has the details. Define
// MALUS_ALLOW_FAST_MATH to be spared the message.
#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#define MALUS_FAST_MATH 1
#if !defined(MALUS_ALLOW_FAST_MATH)
// clang-format off
#pragma message("malus under -ffast-math: error bounds are twice those stated, the degree of polarisation drifts over long chains, last digits depend on the compiler, subnormal numbers may be flushed to zero, NaN and infinity are told by is_finite(), is_close() and is_physical() alone (docs/accuracy.md; no message with MALUS_ALLOW_FAST_MATH)")
// clang-format on
#endif
#else
#define MALUS_FAST_MATH 0
#endif

namespace malus {

/// What this translation unit's compiler flags leave of what the library promises.
namespace config {

/// Compiled with -ffast-math or -ffinite-math-only (/fp:fast).
inline constexpr bool fast_math = MALUS_FAST_MATH != 0;
/// NaN and infinity pass through arithmetic as IEEE 754 says. Where they don't, is_finite(),
/// is_close() and is_physical() tell them by their bits.
inline constexpr bool keeps_nan = !fast_math;
/// What the error bounds of docs/accuracy.md are to be multiplied by.
inline constexpr int error_factor = fast_math ? 2 : 1;

}  // namespace config

/// What the handler is told: the axes of the frame that an operand is in and of the one that it had
/// to be expressed in, and the operation that met them.
struct FrameMismatch {
  double from_x[3], from_y[3];
  double to_x[3], to_y[3];
  const char* operation;
};

using FrameMismatchHandler = void (*)(const FrameMismatch&);

namespace detail {

inline void print_axis(const char* name, const double (&axis)[3]) {
  std::fprintf(stderr, "  %s (%.9g, %.9g, %.9g)\n", name, axis[0], axis[1], axis[2]);
}

inline void abort_on_mismatch(const FrameMismatch& mismatch) {
  std::fprintf(stderr, "malus: %s: the frames describe light of different directions\n",
               mismatch.operation);
  print_axis("from x", mismatch.from_x);
  print_axis("from y", mismatch.from_y);
  print_axis("to   x", mismatch.to_x);
  print_axis("to   y", mismatch.to_y);
  std::abort();
}

inline FrameMismatchHandler& mismatch_handler() {
  static FrameMismatchHandler handler = abort_on_mismatch;
  return handler;
}

}  // namespace detail

/// Replaces the handler of frame mismatches (default: print both frames and abort) and returns the
/// one before. The handler may throw, log or count; when it returns, the operation goes on. Not
/// synchronised: set it before threads start.
inline FrameMismatchHandler set_frame_mismatch_handler(FrameMismatchHandler handler) {
  FrameMismatchHandler before = detail::mismatch_handler();
  detail::mismatch_handler() = handler;
  return before;
}

}  // namespace malus
