// SPDX-License-Identifier: MIT
// The reasons that a wrong expression does not compile. Each is the return type of deleted
// operators, so that the compiler's message names it: "use of deleted function
// 'malus::error::call_propagate_first malus::operator*(…)'".
#pragma once

namespace malus::error {

/// Exitant light met something that expects incident light: propagate() it to the next vertex
/// first.
struct call_propagate_first;
/// Incident light met a transmittance, which expects exitant light: it has been propagated already.
struct already_propagated;
/// Mueller matrices act on what stands to their right: write M * S.
struct mueller_goes_on_the_left;
/// Importance and analyzers measure what stands to their right: write W * M, W * S.
struct importance_goes_on_the_left;
/// Two Stokes vectors have no product; inner_product() is their scalar product.
struct use_inner_product;
/// Two importances have no product: an importance becomes another by Mueller matrices alone.
struct importance_measures_light_only;
/// Readings of sensors have no frame: nothing polarised acts on them or adds to them.
struct measurement_has_no_frame;
/// The frames are of different types: two static frames, or a static and a run-time one. Say how
/// they lie to each other with change_frame<G>(x, rotation).
struct frames_differ;
/// One quantity is on the incident and the other on the exitant side; they describe different
/// light.
struct sides_differ;
/// The components are of different types: convert one (float and double, or different numbers of
/// channels).
struct value_types_differ;
/// Quantities of different kinds have no sum.
struct kinds_differ;

}  // namespace malus::error
