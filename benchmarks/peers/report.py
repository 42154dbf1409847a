# SPDX-License-Identifier: MIT
"""The tables in Markdown, and the plot."""

import math
import os

import estimates

NOTHING = 1e-6  # what of a picture's light is no more than rounding


def summary(row, arguments):
    """What is printed and kept of a row: a dictionary."""
    measured = arguments.passes // 4
    curve, reference_error = estimates.error_curve(row.passes[:measured], row.seconds[:measured], row.passes[measured:])
    for point in curve:
        point["spp"] = point["passes"] * row.spp
    height, width = row.passes[0].shape[:2]
    result = {
        "scene": row.scene.name, "form": row.form, "renderer": row.renderer.name, "variant": row.renderer.variant,
        "polarized": row.renderer.polarized, "threads": arguments.threads, "width": width, "height": height,
        "spp_per_pass": row.spp, "passes": len(row.passes), "seconds": sum(row.seconds),
        "processor_seconds": sum(row.processor_seconds),
        "paths_per_second": width * height * row.spp * len(row.passes) / sum(row.seconds),
        "load_seconds": row.renderer.load_seconds, "compile_seconds": row.renderer.compile_seconds,
        "reference_error_s0": reference_error, "curve": curve}
    for key in ("error_s0", "error_s0_rgb", "error_s123"):
        result[f"{key}_after_1_s"], result[f"{key}_slope"] = estimates.after_one_second(curve, key)
    for key, error in (("error_s0", arguments.error), ("error_s123", arguments.error / 10)):
        result[f"seconds_to_{key}"] = (result[f"{key}_after_1_s"] / error) ** 2
    return result


def find(rows, **wanted):
    return next((r for r in rows if all(r[k] == v for k, v in wanted.items())), None)


def add_ratios(summaries, rows):
    """To the unpolarised twin of the same program, by rounds; to Malus in the same form, by time to equal error."""
    for result, row in zip(summaries, rows):
        twin = {"path, optimized": "path, unpolarized"}.get(result["variant"], result["variant"].replace("_polarized", ""))
        for other, other_row in zip(summaries, rows):
            if result["polarized"] and (other["form"], other["variant"]) == (result["form"], twin):
                ratios = [(a / other_row.spp) / (b / row.spp) for a, b in zip(other_row.seconds, row.seconds)]
                result["polarized_to_unpolarized"] = estimates.median_interval(ratios)
        ours = find(summaries, form=result["form"], renderer="Malus", polarized=result["polarized"])
        if ours:
            result["speed_to_malus"] = ratio(ours["seconds_to_error_s0"], result["seconds_to_error_s0"])


def numbers(found):
    """The same without numbers that JSON doesn't have: null."""
    if isinstance(found, dict):
        return {key: numbers(value) for key, value in found.items()}
    if isinstance(found, (list, tuple)):
        return [numbers(value) for value in found]
    return None if isinstance(found, float) and not math.isfinite(found) else found


def ratio(a, b):
    return a / b if b > 0 else None


def timing_table(summaries, error):
    lines = [f"| scene | renderer | variant | 10³ paths/s | polarised : unpolarised | S0 after 1 s | RGB | S1–S3 "
             f"| s to {100 * error:g} % in S0 | s to {10 * error:g} % in S1–S3 | speed at equal error, Malus = 1 | load, s | compile, s |",
             "|---|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"]
    for r in summaries:
        pair = r.get("polarized_to_unpolarized")
        cells = [f"{r['scene']}, {r['form']}", r["renderer"], r["variant"], f"{r['paths_per_second'] / 1000:.0f}",
                 "{:.2f} ({:.2f} to {:.2f})".format(*pair) if pair else "", percent(r["error_s0_after_1_s"]),
                 percent(r["error_s0_rgb_after_1_s"]), percent(r["error_s123_after_1_s"]) if r["polarized"] else "",
                 seconds(r["seconds_to_error_s0"]), seconds(r["seconds_to_error_s123"]) if r["polarized"] else "",
                 f"{r['speed_to_malus']:.2f}" if r.get("speed_to_malus") else "", f"{r['load_seconds']:.2f}",
                 f"{r['compile_seconds']:.2f}"]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def percent(x):
    return "–" if x != x else f"{100 * x:.3g} %" if x > NOTHING else "0"


def seconds(x):
    return f"{x:.3g}" if x > 1e-6 else "0"


def agreement_table(rows):
    lines = ["| scene | Mitsuba's variant | verdict | greatest \\|z\\| | its limit | mean z² | S0 apart by at most "
             "| S1–S3 apart by at most | size of S1–S3 | gain of S0, S1, S2, S3 (1: as Mitsuba, −1: the other sign) |",
             "|---|---|---|--:|--:|--:|--:|--:|--:|---|"]
    for r in rows:
        polarized = len(r["components"]) > 1 and r["polarized_light"] > 1e-4
        gains = ", ".join(f"{c['gain']:.3f} ± {c['gain_error']:.3f}" if c["gain_error"] < 0.5 else "–" for c in r["components"])
        cells = [f"{r['scene']}, {r['form']}", r["variant"], r["verdict"], f"{r['greatest_z']:.2f}", f"{r['limit']:.2f}",
                 f"{r['mean_square_z']:.2f}", percent(r["apart_s0"]), percent(r["apart_s123"]) if polarized else "",
                 percent(r["polarized_light"]) if len(r["components"]) > 1 else "", gains]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def plot(summaries, file):
    """Error against time: a line of panels for each scene, and for each form S0 and beside it S1 to S3."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    import matplotlib.ticker as ticker

    scenes = list(dict.fromkeys(r["scene"] for r in summaries))
    forms = list(dict.fromkeys(r["form"] for r in summaries))
    twins = list(dict.fromkeys(r["variant"].replace("_polarized", "") for r in summaries if r["renderer"] != "Malus"))
    figure, axes = pyplot.subplots(len(scenes), 2 * len(forms), figsize=(12 * len(forms), 4.4 * len(scenes)), squeeze=False,
                                   layout="constrained")
    for scene, line in zip(scenes, axes):
        for number, axis in enumerate(line):
            form, (key, name) = forms[number // 2], (("error_s0", "S0"), ("error_s123", "S1–S3"))[number % 2]
            for r in summaries:
                points = [(p["seconds"], p[key]) for p in r["curve"] if p[key] > NOTHING]
                if (r["scene"], r["form"]) != (scene, form) or not points:
                    continue
                malus = r["renderer"] == "Malus"
                axis.loglog(*zip(*points), label=f"{r['renderer']} {r['variant']}", linewidth=2 if malus else 1.2, markersize=4,
                            color="black" if malus else f"C{twins.index(r['variant'].replace('_polarized', ''))}",
                            linestyle="-" if r["polarized"] else "--", marker="o" if r["polarized"] else "x")
            if not axis.lines:
                axis.set_axis_off()
                continue
            axis.set_title(f"{scene}, {form}: {name}")
            axis.set_xlabel("seconds of rendering")
            axis.set_ylabel("RMS error / mean S0")
            for scale in (axis.xaxis, axis.yaxis):
                scale.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
                scale.set_major_formatter(ticker.FormatStrFormatter("%g"))
                scale.set_minor_formatter(ticker.NullFormatter())
            axis.grid(True, alpha=0.25)
            axis.legend(fontsize=7)
    temporary = f"{file}.part"
    pyplot.savefig(temporary, dpi=80, format=os.path.splitext(file)[1][1:] or "png")
    os.replace(temporary, file)
