#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the tables of times in README.md and docs anew, between the comments that name them, from what benchmarks/run_all.sh has
measured.

    docs/make_tables.py OUT

OUT is run_all.sh's folder. What was not measured is left as it is, with a line that says so.
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def table(head, rows):
    """Of texts; all columns but those of names are numbers."""
    lines = ["| " + " | ".join(head) + " |", "|" + "|".join("---" if h in ("scene", "algorithm", "mode", "variant", "error of", "rays", "renderer", "pictures") else "--:" for h in head) + "|"]
    return "\n".join(lines + ["| " + " | ".join(r) + " |" for r in rows])


def number(value):
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"


def profile(rows):
    parts = list(dict.fromkeys(p for r in rows for p, ns in r["parts"].items() if ns > 0.01 * r["nanoseconds_per_path"]))
    listed = [[r["scene"], r["integrator"], r["mode"], f"{r['nanoseconds_per_path']:.0f}", f"{r['rays_per_path']:.1f}",
               *(f"{r['parts'].get(p, 0):.0f}" for p in parts)] for r in rows]
    return "Nanoseconds a path, one thread.\n\n" + table(["scene", "algorithm", "mode", "all", "rays a path", *parts], listed)


def instructions(rows):
    parts = {p for r in rows for p, n in r["parts"].items() if n > 0.02 * r["instructions_per_path"]}
    parts = sorted(parts, key=lambda p: -sum(r["parts"].get(p, 0) for r in rows))
    listed = [[r["scene"], r["integrator"], r["mode"], f"{r['instructions_per_path']:.0f}", f"{r['ratio']:.3f}",
               *(f"{r['parts'].get(p, 0):.0f}" for p in parts)] for r in rows]
    return "Instructions a path.\n\n" + table(["scene", "algorithm", "mode", "all", "ratio", *parts], listed)


def limits(content):
    rays = [[r["scene"], r["algorithm"], r["mode"], f"{r['nanoseconds_per_path']:.0f}",
             f"{r['rays_per_path']:.2f} + {r['shadow_rays_per_path']:.2f}", f"{r['nanoseconds_per_ray_alone']:.0f}",
             f"{r['nanoseconds_per_shadow_ray_alone']:.0f}",
             f"{100 * r['share']:.0f} % ({100 * r['share_low']:.0f} to {100 * r['share_high']:.0f})",
             f"{r['nanoseconds_per_path'] * (1 - r['share']):.0f}"] for r in content["rays"]]
    ways = ["path", "wavefront", "packets_of_8", "packets_of_16", "sorting", "sorted", "sorted_packets_of_8", "sorted_packets_of_16"]
    packets = [[r["scene"], r["rays"], *(f"{r[w]:.0f}" for w in ways)] for r in content["packets"]]
    photons = [[r["scene"], r["mode"], str(r["photons"]), str(r["bytes_per_photon"]), f"{r['nanoseconds_to_build_a_photon']:.0f}",
                f"{r['nanoseconds_per_query']:.0f}", f"{r['found_per_query']:.2f}", f"{r['found_gigabytes_per_second']:.2f}",
                f"{r['stream_gigabytes_per_second']:.1f}", f"{r['nanoseconds_per_random_line']:.1f}"] for r in content["photon_map"]]
    return (table(["scene", "algorithm", "mode", "ns a path", "rays + shadow rays", "ns a ray alone", "ns a shadow ray alone",
                   "rays alone, of the time", "ns of the rest"], rays) + "\n\n" +
            table(["scene", "rays", "path by path", "wavefront", "by 8", "by 16", "to sort it", "sorted", "sorted, by 8", "sorted, by 16"], packets) + "\n\n" +
            table(["scene", "mode", "photons", "bytes a photon", "ns to build, a photon", "ns a query", "photons found", "their GB/s",
                   "GB/s in order", "ns of a line at random"], photons))


def convergence(content):
    target, marks = max(content["settings"]["targets"]), {"measured": "", "at_most": "≤ ", "extrapolated": "≈ "}
    # The plots' sampler: the first.
    rows = [r for r in content["rows"] if r["sampler"] == content["settings"]["samplers"][0]]
    variants = list(dict.fromkeys(r["variant"] for r in rows))
    algorithms, listed = list(dict.fromkeys(r["algorithm"] for r in rows)), []
    for scene in dict.fromkeys(r["scene"] for r in rows):
        for quantity, variant in ((q, v) for q in ("S0", "S1-S3") for v in variants):
            cells = []
            for algorithm in algorithms:
                found = [t for r in rows if (r["scene"], r["algorithm"], r["variant"]) == (scene, algorithm, variant) for t in r["time_to"]
                         if t["quantity"] == quantity and t["error"] == target]
                cells.append(marks[found[0]["how"]] + number(found[0]["seconds"]) if found else "—")
            # What has no polarisation is nearer to it than that in most scenes, and never comes nearer.
            if any(c != "—" for c in cells) and (quantity, variant) != ("S1-S3", "unpolarized"):
                listed.append([scene, quantity.replace("-", "–"), variant, *cells])
    return (f"Seconds to a relative error of {target:g} ({content['settings']['resolution']} pixels across; ≤: at the first point "
            "already; ≈: along the line through the last three; —: more than 30 times as long as was measured, or never).\n\n" +
            table(["scene", "error of", "variant", *algorithms], listed))


def samplers(content):
    found = {}
    for g in content["gains"]:
        if g["variant"] == "optimized" and g["sampler"] == "sobol" and g["quantity"] in ("S0", "S1-S3"):
            text = f"{g['ratio']:.2f} ({g['ratio_low']:.2f} to {g['ratio_high']:.2f})"
            found.setdefault((g["scene"], g["algorithm"]), {"samples": g["samples"]})[g["quantity"], g["at_equal"]] = text
    columns = [(q, at) for q in ("S0", "S1-S3") for at in ("samples", "time")]
    listed = [[*key, str(cells["samples"]), *(cells.get(c, "—") for c in columns)] for key, cells in found.items()]
    return table(["scene", "algorithm", "samples a pixel", *(f"{q}, equal {at}" for q, at in columns)], listed)


def scaling(rows):
    listed = [[r["scene"], r["algorithm"], r["mode"], f"{r['ratio']:.2f} ({r['ratio_low']:.2f} to {r['ratio_high']:.2f})"] for r in rows
              if r["dimension"] == "threads" and r["value"] == max(x["value"] for x in rows if x["dimension"] == "threads")]
    most = max((r["value"] for r in rows if r["dimension"] == "threads"), default=0)
    return table(["scene", "algorithm", "mode", f"speed of {most} threads, of one's"], listed)


def variants(rows):
    """The paper's rows."""
    pictures = {}
    for r in rows:
        pictures.setdefault((r["scene"], r["algorithm"]), {})[r["variant"]] = r
    listed = []
    for (scene, algorithm), v in pictures.items():
        if v.get("optimized", {}).get("paper_ratio") and v["naive"]["paper_ratio"]:
            naive, optimized = v["naive"], v["optimized"]
            listed.append([f"`{scene}`", f"`{algorithm}`", f"{v['unpolarized']['paths_per_second'] / 1000:.0f}",
                           f"{naive['ratio']:.3f} ({naive['paper_ratio']:.2f})",
                           f"{optimized['ratio']:.3f} ({optimized['paper_ratio']:.2f}), {optimized['ratio_low']:.3f}–{optimized['ratio_high']:.3f}",
                           f"{v['auto']['ratio']:.3f}"])
    head = ["scene", "algorithm", "unpolarized, 10³ paths/s", "naive (the paper's)", "optimized (the paper's)", "auto"]
    return "\n".join(["| " + " | ".join(head) + " |", "|---|---|--:|---|---|---|"] + ["| " + " | ".join(r) + " |" for r in listed])


def peers(content):
    """Polarised renderers alone."""
    agreements = {(a["scene"], a["form"], a["variant"]): a for a in content["agreement"]}
    listed = []
    for t in (t for t in content["timings"] if t["polarized"]):
        ours = next(o for o in content["timings"] if (o["scene"], o["form"], o["variant"]) == (t["scene"], t["form"], "path, optimized"))
        agreement = agreements.get((t["scene"], t["form"], t["variant"]))
        gains = [f"{c['gain']:.3f} ± {c['gain_error']:.3f}" if c["gain"] is not None and c["gain_error"] < 0.5 else "–" for c in agreement["components"][1:]] if agreement else [""] * 3
        to_equal = [f"{ours[key] / t[key]:.2f}" if t[key] and ours[key] else "–" for key in ("seconds_to_error_s0", "seconds_to_error_s123")]
        listed.append([f"{t['scene']}, {t['form']}", f"{t['renderer']}, {t['variant']}".replace("Malus, path, ", "Malus, "),
                       f"{t['paths_per_second'] / 1000:.0f}", "{:.2f} ({:.2f} to {:.2f})".format(*t["polarized_to_unpolarized"])
                       if t.get("polarized_to_unpolarized") else "–", *to_equal, agreement["verdict"] if agreement else "", *gains])
    return table(["scene", "renderer", "10³ paths/s", "polarised : unpolarised", "speed at equal error of S0", "of S1–S3", "pictures",
                  "gain of S1", "S2", "S3"], listed)


def peers_algebra(text):
    """Of float."""
    return "\n".join(line for line in text.split("### RGB, double")[0].splitlines() if line.startswith("|"))


def connections(text):
    """As it is printed."""
    return text.strip()


def operations(text, old):
    """Of benchmark_algebra's first table, which is of float, the operations that the old table has."""
    measured = {line.split("|")[1].strip(): line for line in text.split("### RGB, double")[0].splitlines() if line.startswith("| ")}
    head, line, *rows = old.strip().splitlines()
    return "\n".join([head, line, *(measured[row.split("|")[1].strip()] for row in rows)])


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: docs/make_tables.py OUT")
    measured = pathlib.Path(sys.argv[1])
    performance = "docs/performance.md"
    for make, source, page in ((variants, "variants.json", "README.md"), (variants, "variants.json", "docs/bidirectional.md"),
                               (connections, "connections.md", "docs/bidirectional.md"), (operations, "algebra.md", "README.md"), (profile, "profile.json", performance),
                               (instructions, "instructions.json", performance),
                               (limits, "limits.json", performance), (convergence, "convergence.json", performance),
                               (samplers, "convergence.json", performance), (scaling, "scaling.json", performance),
                               (peers, "peers.json", "benchmarks/peers/README.md"), (peers_algebra, "peers_algebra.md", "benchmarks/peers/README.md")):
        text = (ROOT / page).read_text(encoding="utf-8")
        begin, end = f"<!-- {make.__name__} -->\n", f"<!-- /{make.__name__} -->\n"
        place = re.search(re.escape(begin) + "(.*?)" + re.escape(end), text, flags=re.DOTALL)
        if not place:
            sys.exit(f"make_tables.py: {page}: there is no place for {make.__name__}")
        try:
            found = (measured / source).read_text(encoding="utf-8")
            made = make(found, place[1]) if make is operations else make(found if source.endswith(".md") else json.loads(found))
        except FileNotFoundError as error:
            print(f"make_tables.py: {make.__name__}: skipped: there is no {error.filename}", file=sys.stderr)
            continue
        except (ValueError, KeyError) as error:
            sys.exit(f"make_tables.py: {source}: {error!r}")
        (ROOT / page).write_text(text[:place.start()] + f"{begin}\n{made}\n\n{end}" + text[place.end():], encoding="utf-8")


if __name__ == "__main__":
    main()
