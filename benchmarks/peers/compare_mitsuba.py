#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Path tracing by malus-render and by Mitsuba 3, side by side: error against time, the cost of polarisation, and whether the pictures agree.

    benchmarks/peers/compare_mitsuba.py --malus build/release/examples/malus-render --seconds 20 --json peers.json --plot peers.png

Run it with a Python that has Mitsuba (pip install mitsuba matplotlib). README.md beside this file says what is compared, and how.
"""

import argparse
import dataclasses
import json
import os
import pathlib
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

SCENES = ["diffuse", "glossy", "glass", "vcm_box", "crossed_polarizers", "upbp_sphere", "malus_law@angle=30", "malus_law@angle=75",
          "brewster@angle=30", "brewster", "brewster@angle=75", "glass_slab@angle=60"]

# The coloured scene is for variants that know colours, the grey one for those that don't; besides, Stokes vectors are compared in it.
VARIANTS = {
    "colour": ["llvm_ad_rgb", "llvm_ad_spectral", "llvm_ad_spectral_polarized", "scalar_rgb", "scalar_spectral",
               "scalar_spectral_polarized"],
    "grey": ["llvm_ad_mono", "llvm_ad_mono_polarized", "llvm_ad_spectral_polarized", "scalar_spectral_polarized"],
}


@dataclasses.dataclass
class Row:
    """A renderer on a scene, and its passes."""
    scene: object
    form: str
    renderer: object
    spp: int = 1
    passes: list = dataclasses.field(default_factory=list)
    seconds: list = dataclasses.field(default_factory=list)
    processor_seconds: list = dataclasses.field(default_factory=list)


def say(text):
    print(text, file=sys.stderr, flush=True)


def calibrate(renderer, seconds, spp):
    """How many samples a pixel take so long, beginning with a few; whatever has to be compiled is compiled after this."""
    from renderers import Failure
    seed = 1 << 30
    while True:
        renderer.warm_up(spp)
        picture, time, _ = renderer.render(spp, seed)
        pixels = picture.shape[0] * picture.shape[1]
        # Dr.Jit's arrays have less than 2^32 elements; and Mitsuba sums a pixel's samples in single precision.
        most = min((1 << 30) // pixels, 1 << 12)
        if time > seconds / 4 or spp >= most:
            if not picture.max() > 0:
                raise Failure("the picture is black")
            spp = max(1, min(most, round(spp * seconds / time)))
            renderer.warm_up(spp)
            return spp
        spp = min(most, 4 * spp)
        seed += 1


def start_renderers(scene, form, arguments, folder):
    """Those that can render the scene, and a line about each that can't."""
    from renderers import Failure, Malus, Mitsuba
    makers = [(f"path, {mode}", lambda m=mode: Malus(arguments.malus, m, arguments.threads, folder))
              for mode in ("unpolarized", "optimized")]
    makers += [(v, lambda v=v: Mitsuba(v, arguments.threads, folder)) for v in VARIANTS[form] if v in arguments.variant]
    rows = []
    for variant, make in makers:
        renderer = None
        try:
            renderer = make()
            renderer.load(scene.file, scene.parameters, scene.folders)
            row = Row(scene, form, renderer)
            # Dr.Jit takes what a single path does for constants of the kernel.
            row.spp = calibrate(renderer, arguments.seconds / arguments.passes, 64 if scene.single_ray else 1)
            rows.append(row)
        except Failure as failure:
            say(f"{scene.name}, {form}, {variant}: skipped: {failure}")
            if renderer:
                renderer.close()
    return rows


def render_in_turns(rows, count):
    """Pass by pass, so that whatever else the machine does falls on all alike; another begins each round."""
    for number in range(count):
        for row in rows[number % len(rows):] + rows[: number % len(rows)]:
            picture, seconds, processor = row.renderer.render(row.spp, number + 1)
            row.passes.append(picture)
            row.seconds.append(seconds)
            row.processor_seconds.append(processor)


def compare_pictures(rows):
    """Malus with each variant of Mitsuba, polarised with polarised and unpolarised with unpolarised."""
    import estimates
    results = []
    for theirs in rows:
        ours = next((r for r in rows if r.renderer.name == "Malus" and r.renderer.polarized == theirs.renderer.polarized), None)
        if theirs.renderer.name == "Malus" or not ours or (theirs.renderer.polarized and not theirs.scene.polarizes_alike):
            continue
        result = {"scene": theirs.scene.name, "form": theirs.form, "variant": theirs.renderer.variant,
                  **estimates.agreement(ours.passes, theirs.passes)}
        agree = result["greatest_z"] <= result["limit"]
        # Spectra of colours are not the colours: a difference is expected, and its size is what counts.
        expected = theirs.form == "colour" and "spectral" in theirs.renderer.variant
        result["verdict"] = "agree" if agree else "differ as spectra and RGB do" if expected else "**differ**"
        results.append(result)
    return results


def run_form(scene, form, arguments):
    """Timings and agreement of one scene in one form."""
    import report
    with tempfile.TemporaryDirectory() as folder:
        rows = []
        try:
            if form == "grey":
                from scenes import grey_twin
                scene = grey_twin(scene, folder)
            rows = start_renderers(scene, form, arguments, folder)
            say(f"{scene.name}, {form}: {arguments.passes} passes of {len(rows)} renderers in turns")
            if len(rows) < 2:
                return [], []
            render_in_turns(rows, arguments.passes)
        finally:
            for row in rows:
                row.renderer.close()
    summaries = [report.summary(row, arguments) for row in rows]
    report.add_ratios(summaries, rows)
    return summaries, compare_pictures(rows)


def scene_file(text, folder):
    name = text.partition("@")[0]
    return pathlib.Path(name) if name.endswith(".xml") else folder / f"{name}.xml"


def read_scene(text, arguments):
    import scenes
    given = dict(p.split("=", 1) for p in text.partition("@")[2].split(",") if p)
    return scenes.read(scene_file(text, arguments.scenes), text, given, arguments.resolution)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--malus", metavar="PROGRAM", help="malus-render; default: the one on PATH")
    parser.add_argument("--scene", action="append", metavar="NAME[@PARAMETER=VALUE,...]",
                        help=f"a scene of the folder, or a file; default: {' '.join(SCENES)}")
    parser.add_argument("--scenes", type=pathlib.Path, default=ROOT / "examples/scenes", metavar="FOLDER")
    parser.add_argument("--form", action="append", choices=list(VARIANTS), help="default: both")
    parser.add_argument("--variant", action="append", choices=sorted({v for vs in VARIANTS.values() for v in vs}),
                        help="of Mitsuba; default: all")
    parser.add_argument("--seconds", type=float, default=20, help="of rendering, for each row (default 20)")
    parser.add_argument("--passes", type=int, default=64, help="independent pictures that make up a row (default 64)")
    parser.add_argument("--threads", "-t", type=int, default=1, help="of each renderer (default 1)")
    parser.add_argument("--resolution", type=int, default=128, help="width of pictures (default 128)")
    parser.add_argument("--error", type=float, default=0.05, help="in S0, to which the time is given (default 0.05)")
    parser.add_argument("--json", metavar="FILE")
    parser.add_argument("--plot", metavar="FILE")
    arguments = parser.parse_args()
    if arguments.passes < 16 or arguments.seconds <= 0 or arguments.threads < 1 or arguments.resolution < 8 or arguments.error <= 0:
        parser.error("--passes is 16 or more, --resolution 8 or more, --seconds, --threads and --error are positive")
    arguments.malus = shutil.which(arguments.malus or "malus-render")
    if not arguments.malus:
        parser.error("malus-render is not found: name it by --malus")
    arguments.scene = arguments.scene or SCENES
    for text in arguments.scene:
        if not scene_file(text, arguments.scenes).is_file():
            parser.error(f"there is no file {scene_file(text, arguments.scenes)}")
        if not all("=" in p for p in text.partition("@")[2].split(",") if p):
            parser.error(f"{text}: after @ come PARAMETER=VALUE, separated by commas")
    arguments.form = arguments.form or list(VARIANTS)
    arguments.variant = arguments.variant or sorted({v for vs in VARIANTS.values() for v in vs})
    return arguments


def main():
    arguments = parse_arguments()
    try:
        import mitsuba
    except ImportError as error:
        say(f"Mitsuba: skipped: {error}; pip install mitsuba")
        return
    mitsuba.set_variant("scalar_rgb")  # which reads OpenEXR files here
    import report
    import scenes
    summaries, agreements = [], []
    for text in arguments.scene:
        try:
            scene = read_scene(text, arguments)
        except scenes.Unsuitable as reason:
            say(f"{text}: skipped: {reason}")
            continue
        for form in arguments.form:
            try:
                timings, agreement = run_form(scene, form, arguments)
            except scenes.Unsuitable as reason:
                say(f"{text}, {form}: skipped: {reason}")
                continue
            # Of a single ray, pictures and their agreement mean something, and its speed is that of starting a rendering.
            summaries += [] if scene.single_ray else timings
            agreements += agreement
    print(f"Mitsuba {mitsuba.__version__}, {arguments.threads} thread(s), pictures {arguments.resolution} wide, "
          f"{arguments.passes} passes in {arguments.seconds:g} s a row\n")
    if summaries:
        print(report.timing_table(summaries, arguments.error) + "\n")
    print(report.agreement_table(agreements))
    if arguments.json:
        found = report.numbers({"timings": summaries, "agreement": agreements})
        pathlib.Path(f"{arguments.json}.part").write_text(json.dumps(found, indent=1, allow_nan=False) + "\n")
        os.replace(f"{arguments.json}.part", arguments.json)
    if arguments.plot and summaries:
        try:
            report.plot(summaries, arguments.plot)
        except ImportError as error:
            say(f"the plot: skipped: {error}; pip install matplotlib")


if __name__ == "__main__":
    main()
