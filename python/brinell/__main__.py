"""The ``brinell`` command, as the wheel carries it: ``brinell`` or ``python -m brinell``."""

from __future__ import annotations

import os
import signal
import sys

from brinell import _brinell


def main() -> int:
    """Run the command with the process's arguments; its exit code."""
    # Ctrl-C is the command's own.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _brinell.command(["brinell", *sys.argv[1:]], [sys.executable, os.path.abspath(sys.argv[0])])


if __name__ == "__main__":
    sys.exit(main())
