# SPDX-License-Identifier: MIT
"""The programs that are compared, behind one interface: load a scene, render so many samples a pixel with a seed, say how long that took.

Pictures are arrays of rows, columns, Stokes components (one, if the program follows no polarisation) and colours (three, or one).
"""

import ctypes
import glob
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import time

import numpy

# LLVM's code generator for x86 knows no vector minimum and maximum of IEEE 754-2019 before this version, and aborts
# ("Cannot select: fminimum") over the kernels that Dr.Jit writes.
OLDEST_LLVM = 17


class Failure(Exception):
    """A program that isn't there, or refuses a scene; the text is one line."""


def first_line(text):
    lines = [line.strip() for line in text.strip().splitlines() if line.strip()]
    return re.sub(r"\x1b\[[0-9;]*m", "", lines[0])[:300] if lines else "no message"


class Malus:
    name = "Malus"

    def __init__(self, program, mode, threads, folder):
        self.program, self.mode, self.threads, self.folder = program, mode, threads, pathlib.Path(folder)
        self.variant, self.polarized = f"path, {mode}", mode != "unpolarized"
        self.compile_seconds = 0.0

    def load(self, file, parameters, folders):
        del folders  # malus-render looks beside every file that it reads
        self.scene = [str(file)] + [x for k, v in parameters.items() for x in ("-D", f"{k}={v}")]
        start = time.perf_counter()
        self._run(1, 0)
        self.load_seconds = time.perf_counter() - start - self.last["seconds"]

    def warm_up(self, spp):
        self._run(spp, 0)

    def render(self, spp, seed):
        """The picture, seconds of rendering as --stats has them, and of processor time, which is that of the whole program."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self._run(spp, seed)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        processor = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
        return read_stokes(self.folder / "malus.exr", self.polarized), self.last["seconds"], processor

    def _run(self, spp, seed):
        command = [self.program, *self.scene, "-o", str(self.folder / "malus.exr"), "--stats", str(self.folder / "malus.json"),
                   "--mode", self.mode, "--spp", str(spp), "--seed", str(seed), "--threads", str(self.threads)]
        result = subprocess.run(command, capture_output=True, text=True)
        if result.returncode != 0:
            raise Failure(first_line(result.stderr))
        self.last = json.loads((self.folder / "malus.json").read_text())

    def close(self):
        pass


def read_stokes(file, polarized):
    """The four components, or S0 alone, of an OpenEXR file with channels S0.R to S3.B."""
    import mitsuba
    bitmap = mitsuba.Bitmap(str(file))
    names = [field.name for field in bitmap.struct_()]
    pixels = numpy.array(bitmap)
    components = range(4 if polarized else 1)
    return numpy.stack([numpy.stack([pixels[..., names.index(f"S{s}.{c}")] for c in "RGB"], -1) for s in components], -2)


class Mitsuba:
    name = "Mitsuba"

    def __init__(self, variant, threads, folder):
        self.variant, self.folder = variant, pathlib.Path(folder)
        self.polarized = "polarized" in variant
        self.errors = open(self.folder / f"{variant}.log", "w+")
        # An empty cache of kernels, so that the time to compile them is that of a first run.
        environment = os.environ | {"DRJIT_CACHE_DIR": str(self.folder / f"{variant}.kernels")}
        if variant.startswith("llvm") and "DRJIT_LIBLLVM_PATH" not in environment:
            environment["DRJIT_LIBLLVM_PATH"] = newest_llvm()
        os.makedirs(environment["DRJIT_CACHE_DIR"], exist_ok=True)
        script = pathlib.Path(__file__).with_name("mitsuba_worker.py")
        self.process = subprocess.Popen([sys.executable, str(script), variant, str(threads)], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=self.errors, text=True, env=environment)
        self._answer()

    def load(self, file, parameters, folders):
        self.load_seconds = self._ask(do="load", file=str(file), parameters=parameters, folders=folders)["seconds"]
        self.compile_seconds = 0.0

    def warm_up(self, spp):
        self.compile_seconds += self._ask(do="render", spp=spp, seed=0, picture=None)["compile_seconds"]

    def render(self, spp, seed):
        picture = str(self.folder / f"{self.variant}.npy")
        answer = self._ask(do="render", spp=spp, seed=seed, picture=picture)
        return numpy.load(picture), answer["seconds"], answer["processor_seconds"]

    def _ask(self, **request):
        try:
            self.process.stdin.write(json.dumps(request) + "\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            pass  # what it said before it ended is read below
        return self._answer()

    def _answer(self):
        line = self.process.stdout.readline()
        if not line:
            self.process.wait()
            self.errors.seek(0)
            raise Failure(f"ended with status {self.process.returncode}: {first_line(self.errors.read())}")
        answer = json.loads(line)
        if "error" in answer:
            raise Failure(first_line(answer["error"]))
        return answer

    def close(self):
        self.process.stdin.close()
        self.process.stdout.close()
        self.process.wait()
        self.errors.close()


def newest_llvm():
    """The library of LLVM with the highest version that is installed where Linux distributions put it."""
    found = {}
    for pattern in ("/usr/lib/*-linux-gnu/libLLVM*.so*", "/usr/lib/llvm-*/lib/libLLVM*.so*", "/usr/lib64/libLLVM*.so*",
                    "/usr/lib/libLLVM*.so*"):
        for file in glob.glob(pattern):
            match = re.search(r"libLLVM[-.](?:so\.)?(\d+)", file)
            if match:
                found.setdefault(int(match[1]), file)
    if not found or max(found) < OLDEST_LLVM:
        raise Failure(f"no library of LLVM {OLDEST_LLVM} or newer, the newest here is {max(found, default='none')}: "
                      "install one (Debian: libllvm19) or name it in DRJIT_LIBLLVM_PATH")
    library = found[max(found)]
    try:
        ctypes.CDLL(library)
    except OSError as error:
        raise Failure(f"{library}: {error}") from error
    return library
