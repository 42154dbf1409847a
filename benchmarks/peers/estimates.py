# SPDX-License-Identifier: MIT
"""Errors and agreement, from independent pictures ("passes") of one scene.

A picture's array has rows, columns, Stokes components and colours; a row of the benchmark holds a list of them, all with equally many
samples a pixel.
"""

import math

import numpy

from scenes import LUMINANCE


def luminance(pictures):
    """Without the last axis."""
    return pictures[..., 0] if pictures.shape[-1] == 1 else pictures @ numpy.array(LUMINANCE, pictures.dtype)


def mean_square_errors(pictures, reference, reference_variance):
    """Of each Stokes component, the mean over pixels and pictures, without what the reference's own noise adds."""
    axes = tuple(i for i in range(pictures.ndim) if i != 3)
    noise = reference_variance.mean(axis=tuple(i for i in range(reference_variance.ndim) if i != 2))
    return numpy.maximum(((pictures - reference) ** 2).mean(axis=axes, dtype=numpy.float64) - noise, 0)


def error_curve(passes, seconds, reference_passes):
    """Root mean square errors, as parts of the mean S0, of means of 1, 2, 4, … passes against the mean of others; and how good that is."""
    curve = []
    passes, reference_passes = numpy.stack(passes), numpy.stack(reference_passes)
    grey, grey_reference = luminance(passes)[..., None], luminance(reference_passes)[..., None]
    light = float(grey_reference[..., 0, :].mean(dtype=numpy.float64))
    n = len(reference_passes)
    length = 1
    while length <= len(passes):
        groups = len(passes) // length

        def errors(all_passes, references):
            means = all_passes[: groups * length].reshape(groups, length, *all_passes.shape[1:]).mean(axis=1)
            return mean_square_errors(means, references.mean(axis=0), references.var(axis=0, ddof=1) / n)

        squares, colour_squares = errors(grey, grey_reference), errors(passes, reference_passes)
        curve.append({"passes": length, "seconds": length * float(numpy.mean(seconds)),
                      "error_s0": math.sqrt(squares[0]) / light, "error_s0_rgb": math.sqrt(colour_squares[0]) / light,
                      "error_s123": math.sqrt(squares[1:].sum()) / light})
        length *= 2
    reference_error = math.sqrt(float((grey_reference[:, :, :, 0].var(axis=0, ddof=1) / n).mean())) / light
    return curve, reference_error


def after_one_second(curve, key):
    """The error at 1 s by the law 1/√t, the geometric mean over the curve; and the curve's slope in logarithms, −½ of that law."""
    points = [(p["seconds"], p[key]) for p in curve if p[key] > 0]
    if not points:
        return 0.0, math.nan
    error = math.exp(sum(math.log(e * math.sqrt(t)) for t, e in points) / len(points))
    if len(points) < 2:
        return error, math.nan
    return error, float(numpy.polyfit(*zip(*((math.log(t), math.log(e)) for t, e in points)), 1)[0])


def median_interval(values):
    """The median and its interval of 95 %, by order statistics."""
    ordered = sorted(values)
    n, half = len(ordered), 0.98 * math.sqrt(len(ordered))
    return (float(numpy.median(ordered)), ordered[max(0, math.floor(n / 2 - half))],
            ordered[min(n - 1, math.ceil(n / 2 + half) - 1)])


# agreement

ROUNDING = 1e-5  # of the mean S0: pictures are sums of up to some thousand samples in single precision
FALSE_ALARMS = 1e-3  # the chance that any z of two pictures of the same expectation is called a difference


def tiles(passes, count):
    """Means over count × count parts of each picture: passes, parts, components, colours."""
    p = numpy.stack(passes).astype(numpy.float64)
    rows, columns = min(count, p.shape[1]), min(count, p.shape[2])
    parts = [part.mean(axis=(1, 2)) for half in numpy.array_split(p, rows, axis=1)
             for part in numpy.array_split(half, columns, axis=2)]
    return numpy.stack(parts, axis=1)


def normal_score(t, degrees):
    """The normal deviate as improbable as a value of Student's t (Wallace 1959)."""
    return numpy.sign(t) * numpy.sqrt(degrees * numpy.log1p(t * t / degrees)) * (8 * degrees + 1) / (8 * degrees + 3)


def greatest_normal_score(count):
    """What the greatest of so many independent |z| exceeds with the chance FALSE_ALARMS: by bisection of the complementary error function."""
    chance = -math.expm1(math.log1p(-FALSE_ALARMS) / count)
    low, high = 0.0, 40.0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if math.erfc(middle / math.sqrt(2)) > chance else (low, middle)
    return high


def agreement(ours, theirs, tile_count=8):
    """Whether two lists of pictures have the same expectation, by Welch's test on parts of the picture and by their regression; and how far
    apart they are.

    If one has S0 alone, S0 is compared; if one is grey, the other's first colour, which in a grey scene is like the others.
    """
    a, b = tiles(ours, tile_count), tiles(theirs, tile_count)
    components, colours = min(a.shape[2], b.shape[2]), min(a.shape[3], b.shape[3])
    a, b = a[:, :, :components, :colours], b[:, :, :components, :colours]
    light = float(b[:, :, 0].mean())
    va, vb = a.var(axis=0, ddof=1) / len(a), b.var(axis=0, ddof=1) / len(b)
    floor = (ROUNDING * light) ** 2
    difference, variance = a.mean(axis=0) - b.mean(axis=0), va + vb + floor
    degrees = variance ** 2 / ((va ** 2) / (len(a) - 1) + (vb ** 2) / (len(b) - 1) + floor ** 2 / 1e6)
    z = normal_score(difference / numpy.sqrt(variance), degrees)
    result = {"tests": z.size + components, "limit": greatest_normal_score(z.size + components),
              "mean_square_z": float((z ** 2).mean()), "components": []}
    weights = 1 / variance
    for s in range(components):
        result["components"].append({
            "component": f"S{s}", "greatest_tile_z": float(abs(z[:, s]).max()),
            **gain(a[:, :, s], b[:, :, s], floor)})
    result["greatest_z"] = max(max(c["greatest_tile_z"], abs(c["gain_z"])) for c in result["components"])
    result["apart_s0"] = apart(difference[:, :1], b.mean(axis=0)[:, :1], vb[:, :1], weights[:, :1])
    result["apart_s123"] = apart(difference[:, 1:], b.mean(axis=0)[:, 1:], vb[:, 1:], weights[:, 1:])
    signal = (b.mean(axis=0) ** 2 - vb)[:, 1:].sum(axis=1).mean()
    result["polarized_light"] = math.sqrt(max(float(signal), 0)) / light if components > 1 else 0.0
    return result


def gain(a, b, floor):
    """The weighted regression of the mean of a's passes on that of b's, through 0: 1 if they agree, −1 if a sign differs; its standard
    error, from the spread of passes, whose colours vary together; and how many of those it is from 1, which is finite also where b is all
    noise.

    The weights for one half of the passes come from the other half's variances: those of the same samples are small where rare bright
    ones are missing, and would favour what is too dark.
    """
    power = excess = squared_error = 0.0
    for half in range(2):
        weights = 1 / (sum(x[1 - half::2].var(axis=0, ddof=1) / len(x[half::2]) for x in (a, b)) + floor)
        ours, theirs = a[half::2], b[half::2]
        mean, variance = theirs.mean(axis=0), theirs.var(axis=0, ddof=1) / len(theirs)
        power += float((weights * (mean ** 2 - variance)).sum())
        excess += float((weights * ((ours.mean(axis=0) - mean) * mean + variance)).sum())
        squared_error += sum(float((weights * mean * x).sum(axis=(1, 2)).var(ddof=1)) / len(x) for x in (ours, theirs))
        squared_error += floor * float((weights * abs(mean)).sum()) ** 2 + float(((weights * variance) ** 2).sum())
    error = math.sqrt(squared_error)
    return {"gain": 1 + excess / power if power > 0 else math.nan, "gain_error": error / power if power > 0 else math.nan,
            "gain_z": excess / error if error > 0 else 0.0}


def apart(difference, b, variance_of_b, weights):
    """How far apart the pictures may be, as a part of b, at 95 %: weighted root mean squares, less what noise alone makes of them."""
    power = float((weights * (b ** 2 - variance_of_b)).sum())
    n, colours = difference.size, difference.shape[-1]  # which vary together
    if n == 0 or power <= 0:
        return math.nan
    excess = float((weights * difference ** 2).sum()) - n
    return math.sqrt(max(excess, 0) + 1.645 * math.sqrt(2 * n * colours)) / math.sqrt(power)
