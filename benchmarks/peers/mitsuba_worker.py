#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One variant of Mitsuba 3 in a process of its own, which compare_mitsuba.py talks to.

A request is a line of JSON on standard input, the answer one on standard output; pictures go through files. A process for each variant
keeps the variants' just-in-time compilers and caches apart, and a failure of one (an unsuitable LLVM library aborts) from the others.
"""

import json
import os
import sys
import time

import drjit
import mitsuba
import numpy


class Worker:
    def __init__(self, variant, threads):
        mitsuba.set_variant(variant)
        mitsuba.set_log_level(mitsuba.LogLevel.Error)
        drjit.set_thread_count(threads)  # the calling thread is one of them
        self.variant = variant
        self.compiles = variant.startswith("llvm")

    def load(self, file, parameters, folders):
        """Reads a scene and builds its acceleration structure."""
        for folder in folders:
            mitsuba.file_resolver().append(folder)
        start = time.perf_counter()
        self.scene = mitsuba.load_file(file, **parameters)
        self.integrator = self.scene.integrator()
        if "polarized" in self.variant:
            self.integrator = mitsuba.load_dict({"type": "stokes", "nested": self.integrator})
        return {"seconds": time.perf_counter() - start}

    def render(self, spp, seed, picture):
        """Renders and measures; the time ends when the picture is in memory."""
        if self.compiles:
            drjit.set_flag(drjit.JitFlag.KernelHistory, picture is None)
        start, processor = time.perf_counter(), time.process_time()
        pixels = numpy.array(self.integrator.render(self.scene, seed=seed, spp=spp), dtype=numpy.float32)
        answer = {"seconds": time.perf_counter() - start, "processor_seconds": time.process_time() - processor}
        if picture is None:
            kernels = drjit.kernel_history() if self.compiles else []
            answer["compile_seconds"] = sum(k.get("codegen_time", 0) + k.get("backend_time", 0) for k in kernels) / 1000
        else:
            numpy.save(picture, self.stokes(pixels))
        return answer

    def stokes(self, pixels):
        """Rows, columns, the components that there are, and colours: three, or one of a monochromatic variant."""
        height, width, _ = pixels.shape
        if "polarized" in self.variant:
            pixels = pixels[:, :, -12:].reshape(height, width, 4, 3)
        else:
            pixels = pixels.reshape(height, width, 1, -1)[..., :3]
        return pixels[..., :1] if "mono" in self.variant else pixels


def main():
    # Whatever the libraries print goes to standard error.
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)
    try:
        worker = Worker(sys.argv[1], int(sys.argv[2]))
        answers.write(json.dumps({"ready": True}) + "\n")
    except Exception as error:
        answers.write(json.dumps({"error": str(error)}) + "\n")
        return
    for line in sys.stdin:
        request = json.loads(line)
        try:
            answer = getattr(worker, request.pop("do"))(**request)
        except Exception as error:
            answer = {"error": str(error)}
        answers.write(json.dumps(answer) + "\n")


if __name__ == "__main__":
    main()
