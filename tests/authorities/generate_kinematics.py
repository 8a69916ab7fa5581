"""Records where LinuxCNC's tables with two rotary axes (xyzac-trt, xyzbc-trt) have the tip: kinematics.json.

The modules are those of the package linuxcnc-uspace. What they ask of the hardware layer is answered by a few lines of C that
keep their pins, so that their forward transformation runs by itself. Needs gcc and numpy:

    python tests/authorities/generate_kinematics.py
"""

import ctypes
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
MODULES = "/usr/lib/linuxcnc/modules"
PINS = ("x-rot-point", "y-rot-point", "z-rot-point", "x-offset", "y-offset", "z-offset", "tool-offset")
LAYER = r"""
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
static double *values[64];
static char names[64][64];
static int many;
int hal_init(const char *name) { return 1; }
int hal_exit(int component) { return 0; }
int hal_ready(int component) { return 0; }
void *hal_malloc(long size) { return calloc(1, size); }
int hal_pin_bit_new(const char *name, int way, void **data, int component) { *data = calloc(1, 8); return 0; }
int hal_pin_s32_new(const char *name, int way, void **data, int component) { *data = calloc(1, 8); return 0; }
int hal_pin_float_newf(int way, double **data, int component, const char *format, ...) {
  va_list list;
  va_start(list, format);
  vsnprintf(names[many], 64, format, list);
  va_end(list);
  values[many++] = *data = calloc(1, 8);
  return 0;
}
void rtapi_print(const char *format, ...) {}
void rtapi_print_msg(int level, const char *format, ...) {}
int pin_count(void) { return many; }
const char *pin_name(int number) { return names[number]; }
void pin_set(int number, double value) { *values[number] = value; }
"""


def recorded(module: str, count: int = 40) -> list[dict[str, object]]:
    """Positions of the joints, offsets, and where the module has the tip, tool offset included along Z."""
    with tempfile.TemporaryDirectory() as folder:
        source, library = Path(folder) / "layer.c", Path(folder) / "layer.so"
        source.write_text(LAYER, "utf-8")
        subprocess.run(["gcc", "-shared", "-fPIC", "-o", library, source], check=True)
        layer = ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)
    layer.pin_name.restype, layer.pin_set.argtypes = ctypes.c_char_p, [ctypes.c_int, ctypes.c_double]
    kinematics = ctypes.CDLL(f"{MODULES}/{module}-kins.so")
    assert kinematics.rtapi_app_main() == 0
    names = [layer.pin_name(k).decode().split(".")[1] for k in range(layer.pin_count())]
    assert sorted(names) == sorted(PINS), names
    random, found = np.random.default_rng(39), []
    for _ in range(count):
        pins = dict(zip(PINS, random.uniform(-60, 60, len(PINS)).round(3).tolist()))
        joints = [*random.uniform(-300, 300, 3).round(3).tolist(), *random.uniform(-180, 180, 2).round(3).tolist()]
        for number, name in enumerate(names):
            layer.pin_set(number, pins[name])
        given, tip, flags = (ctypes.c_double * 9)(*joints), (ctypes.c_double * 9)(), ctypes.c_ulong(0)
        assert kinematics.kinematicsForward(given, tip, ctypes.byref(flags), ctypes.byref(flags)) == 0
        found.append({"pins": pins, "joints": joints, "tip": [*tip[:3]]})
    return found


if __name__ == "__main__":
    if len(sys.argv) > 1:  # a process for each: the modules keep their names for themselves
        print(json.dumps(recorded(sys.argv[1])))
    else:
        run = [sys.executable, __file__]
        answers = {m: json.loads(subprocess.check_output([*run, m])) for m in ("xyzac-trt", "xyzbc-trt")}
        text = json.dumps({"of": "LinuxCNC 2.9.0~pre1", **answers}, indent=0)
        (HERE / "kinematics.json").write_text(text + "\n", "utf-8")
