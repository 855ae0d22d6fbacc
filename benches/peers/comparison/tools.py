"""Words to the user, and commands."""

import os
import pathlib
import subprocess
import time


def say(text):
    print(f"[{time.monotonic() - STARTED:5.0f} s] {text}", flush=True)


STARTED = time.monotonic()


class Missing(Exception):
    """Why a peer cannot be had."""


def capture(command, **more):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **more)
    if done.returncode:
        tail = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:]
        raise Missing(f"{pathlib.Path(command[0]).name} ended with {done.returncode}: {' '.join(tail)}")
    return done.stdout


def one_thread():
    """Small vectors: threads of the linear algebra would only cost time, and they would blur CPU time."""
    return os.environ | {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}
