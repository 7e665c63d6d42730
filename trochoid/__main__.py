"""`python -m trochoid`."""

import sys

from trochoid.cli import main

if __name__ == "__main__":
    sys.exit(main())
