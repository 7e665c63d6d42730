"""Compare a wheel with the files that git tracks in the packages; exit with the list of differences."""

import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

WINGS = ("kinematics", "geometry", "fem", "dynamics")


def tracked() -> set[str]:
    """Return the tracked files of all packages, as they are called when installed."""
    command = ["git", "ls-files", "trochoid", *WINGS]
    listing = subprocess.run(command, check=True, capture_output=True, text=True)
    files = {line for line in listing.stdout.splitlines() if not Path(line).is_symlink()}
    return {file if file.startswith("trochoid/") else f"trochoid/{file}" for file in files}


def packed(wheel: str) -> set[str]:
    """Return the files of the wheel other than its metadata."""
    return {name for name in ZipFile(wheel).namelist() if ".dist-info/" not in name}


faults = [f"not in the wheel: {name}" for name in sorted(tracked() - packed(sys.argv[1]))]
faults += [f"only in the wheel: {name}" for name in sorted(packed(sys.argv[1]) - tracked())]
sys.exit("\n".join(faults) if faults else 0)
