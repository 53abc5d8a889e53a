"""Builds what the wheel needs besides Python: the library, by cargo, and its declarations for cffi.

One wheel serves all versions of Python. PERIODYN_LIBRARY, if set, is a shared library that is
there already, such as CMake's.
"""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from cffi import FFI
from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NAMES = {"darwin": "libperiodyn.dylib", "win32": "periodyn.dll"}


class Library(BuildHookInterface):
    """The hook of hatchling."""

    def initialize(self, version, build_data):
        here = Path(self.root)
        name = NAMES.get(sys.platform, "libperiodyn.so")
        shutil.copyfile(self.library(here.parent, name), here / "periodyn" / name)
        ffi = FFI()
        ffi.cdef(declarations((here.parent / "include/periodyn.h").read_text(encoding="utf-8")))
        ffi.set_source("periodyn._abi", None)
        ffi.emit_python_code(str(here / "periodyn/_abi.py"))
        made = [f"periodyn/{name}", "periodyn/_abi.py"]
        build_data["artifacts"] += made
        build_data["pure_python"] = False
        platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
        build_data["tag"] = f"py3-none-{platform}"

    @staticmethod
    def library(root, name):
        """The shared library."""
        given = os.environ.get("PERIODYN_LIBRARY")
        if given:
            return Path(given)
        subprocess.run(["cargo", "rustc", "--lib", "--crate-type", "cdylib", "--release",
                        "--locked"], cwd=root, check=True)
        target = os.environ.get("CARGO_TARGET_DIR", root / "target")
        return Path(root, target, "release", name)


def declarations(header):
    """What the header declares, without what is for the preprocessor."""
    header = re.sub(r"/\*.*?\*/", "", header, flags=re.S)
    header = re.sub(r"^#ifdef __cplusplus.*?^#endif.*?$", "", header, flags=re.M | re.S)
    header = re.sub(r"^\s*#(.*\\\n)*.*$", "", header, flags=re.M)
    header = re.sub(r"^static inline .*?^}$", "", header, flags=re.M | re.S)
    return re.sub(r"\bPDN_API\b", "", header)
