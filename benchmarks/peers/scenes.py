# SPDX-License-Identifier: MIT
"""What of a scene both programs can render alike, and its grey twin.

A spectral renderer makes spectra of RGB colours and a monochromatic one their luminance, so that a coloured scene is not quite the same
scene in each. Its grey twin is: every colour is replaced by its luminance, every named metal by one complex index for all wavelengths. All
variants then compute the same light, and their pictures may differ by noise alone.
"""

import dataclasses
import pathlib
import re
import xml.etree.ElementTree as xml

LUMINANCE = (0.212671, 0.715160, 0.072169)

# Index and extinction at about 550 nm. What they are is of no importance: both programs are given the same.
GREY_METALS = {"Al": (0.96, 6.69), "Ag": (0.13, 3.34), "Au": (0.42, 2.35), "Cu": (1.04, 2.59), "Cr": (3.18, 3.31)}

DEPOLARIZING_IN_MITSUBA = {"plastic", "roughdielectric"}
SCALAR_PHASE_FUNCTIONS = {"isotropic", "hg"}


@dataclasses.dataclass
class Scene:
    name: str
    file: pathlib.Path
    parameters: dict  # of the scene, for -D
    folders: list  # where Mitsuba, which doesn't look beside included files, finds theirs
    polarizes_alike: bool  # all its materials are polarising in Mitsuba, too
    single_ray: bool  # a film of one pixel
    grey: bool = False


class Unsuitable(Exception):
    """Why a scene cannot be compared."""


def read(file, name, given, resolution):
    """A scene as it stands, in a picture so many pixels wide where its size is a parameter."""
    trees, folders = [xml.parse(file)], []
    for element in trees[0].iter("include"):
        included = file.parent / element.get("filename")
        trees.append(xml.parse(included))
        folders.append(str(included.parent))
    defaults = {e.get("name"): e.get("value") for e in trees[0].iter("default")} | given
    parameters = dict(given)
    if "resolution" in defaults:
        parameters.setdefault("resolution", str(resolution))
    elif "width" in defaults and "height" in defaults:
        parameters.setdefault("width", str(resolution))
        parameters.setdefault("height", str(resolution * int(defaults["height"]) // int(defaults["width"])))

    def types(tag):
        return {defaults.get(t[1:], t) if t.startswith("$") else t
                for tree in trees for t in (e.get("type") for e in tree.iter(tag)) if t}

    integrators = types("integrator") - {"stokes"}
    if not integrators <= {"path", "volpath"}:
        raise Unsuitable(f"its integrator is {', '.join(sorted(integrators))}: Mitsuba has no such, or not with polarisation")
    if types("medium"):
        if "path" in integrators:
            raise Unsuitable("it has a medium, which Mitsuba's path does not see")
        polarizing = types("phase") - SCALAR_PHASE_FUNCTIONS
        if polarizing:
            raise Unsuitable(f"its phase function {', '.join(sorted(polarizing))} polarises in Malus alone")
    return Scene(name, file, parameters, folders, not types("bsdf") & DEPOLARIZING_IN_MITSUBA,
                 "radiancemeter" in types("sensor"))


def grey_twin(scene, folder):
    """Written to the folder; the scene must be one file, and have no textures."""
    tree = xml.parse(scene.file)
    if any(e.get("name") == "filename" or e.tag == "include" for e in tree.iter()):
        raise Unsuitable("no grey twin: it has files of textures or meshes")
    for element in tree.iter("rgb"):
        numbers = [float(x) for x in re.split(r"[,\s]+", element.get("value").strip())]
        element.set("value", f"{sum(w * x for w, x in zip(LUMINANCE, numbers * (3 if len(numbers) == 1 else 1))):.9g}")
    for bsdf in tree.iter("bsdf"):
        for material in bsdf.findall("string[@name='material']"):
            if material.get("value") == "none":
                continue
            if material.get("value") not in GREY_METALS:
                raise Unsuitable(f"no grey twin: no single index is listed for the metal {material.get('value')}")
            bsdf.remove(material)
            for name, value in zip(("eta", "k"), GREY_METALS[material.get("value")]):
                xml.SubElement(bsdf, "spectrum", name=name, value=str(value))
    file = pathlib.Path(folder) / f"{scene.file.stem}_grey.xml"
    tree.write(file)
    return dataclasses.replace(scene, file=file, grey=True)
