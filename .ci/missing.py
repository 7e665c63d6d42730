"""Print the Debian packages that the set-up needs and this machine lacks."""

import ctypes
import sys
from importlib.util import find_spec

PACKAGE_OF = {
    "libEGL.so.1": "libegl1",
    "libGL.so.1": "libgl1",
    "libGLU.so.1": "libglu1-mesa",
    "libX11.so.6": "libx11-6",
    "libXcursor.so.1": "libxcursor1",
    "libXext.so.6": "libxext6",
    "libXfixes.so.3": "libxfixes3",
    "libXft.so.2": "libxft2",
    "libXinerama.so.1": "libxinerama1",
    "libXrender.so.1": "libxrender1",
    "libfontconfig.so.1": "libfontconfig1",
    "libgomp.so.1": "libgomp1",
    "libz.so.1": "zlib1g",
}


def is_missing(library: str) -> bool:
    """Say whether the dynamic linker finds no such library."""
    try:
        ctypes.CDLL(library)
    except OSError:
        return True
    return False


packages = []
if find_spec("ensurepip") is None or find_spec("venv") is None:
    packages.append(f"python{sys.version_info.major}.{sys.version_info.minor}-venv")
if sys.platform == "linux":
    packages += [package for library, package in PACKAGE_OF.items() if is_missing(library)]
print(*packages)
