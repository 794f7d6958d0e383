#!/usr/bin/python3
"""Tests the watchdog's program on a kiosk that is simulated by files: it is small, feeds its service manager, and orders the steps in turn.

    watchdog_program.py PROGRAM
"""

import json
import os
import pathlib
import re
import select
import socket
import subprocess
import sys
import tempfile

PROGRAM = sys.argv[1]
MAX_RESIDENT_KIB = 8 * 1024
FORBIDDEN = ("libGL", "libEGL", "libgbm", "libusb", "libhidapi", "libsodium", "libzip", "libdrm")


def resident_kib(process):
    text = pathlib.Path(f"/proc/{process}/status").read_text(encoding="utf-8")
    return {key: int(value) for key, value in re.findall(r"(VmRSS|VmLck|Threads):\s+(\d+)", text)}


def hear(listener, process):
    """The program's next message to its service manager."""
    ended = os.pidfd_open(process.pid)
    try:
        heard, _, _ = select.select([listener, ended], [], [])
    finally:
        os.close(ended)
    assert listener in heard, f"it has ended with {process.wait()}"
    return listener.recv(4096).decode()


def main():
    libraries = subprocess.run(["ldd", PROGRAM], check=True, capture_output=True, text=True).stdout
    assert not [name for name in FORBIDDEN if name in libraries], libraries
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name in ("run", "state", "root/proc/sys/kernel/random", "root/run/frustumscreen"):
            (folder / name).mkdir(parents=True)
        (folder / "root/proc/sys/kernel/random/boot_id").write_text("b1\n", encoding="utf-8")
        listener = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        listener.bind(str(folder / "notify"))
        ends = folder / "root/run/frustumscreen/ends"
        process = subprocess.Popen(
            [PROGRAM, "--run-folder", folder / "run", "--state-folder", folder / "state", "--root", folder / "root"],
            env={"NOTIFY_SOCKET": str(folder / "notify")})
        try:
            heard = [hear(listener, process) for _ in range(4)]
            assert "READY=1" in heard and heard.count("WATCHDOG=1") >= 2, heard
            assert (folder / "run/mode").read_text(encoding="utf-8") == "normal\n"
            ends.write_text("1.0 exit-code exited 1\n" * 3, encoding="utf-8")  # it ended three times
            while not (folder / "run/steps/restart-exhibit").exists():
                hear(listener, process)  # it feeds the manager after each look
            assert (folder / "run/mode").read_text(encoding="utf-8") == "plain\n"  # there is no other set, nor a device
            reason = (folder / "run/reason").read_text(encoding="utf-8")
            assert reason.startswith("the exhibit's program ends again and again: it ended with an error (exited 1); "), reason
            size = resident_kib(process.pid)
            print(f"{size['VmRSS']} KiB resident, {size['VmLck']} KiB may be locked")
            assert size["VmRSS"] <= MAX_RESIDENT_KIB and size["Threads"] == 1, size
        finally:
            listener.close()  # a program that has sent many messages would wait for their reader
            process.terminate()
            assert process.wait() == 0
        status = json.loads((folder / "run/status.json").read_text(encoding="utf-8"))
        assert status["mode"] == "plain" and status["step"]["name"] == "draw_plainly", status
        assert status["step"]["cause"] == "keeps_ending" and status["reboots_today"] == 0, status
        fault = status["faults"][0]
        assert fault["cause"] == "keeps_ending" and fault["detail"] == "exit-code exited 1" and fault["helped"] is None, fault
        assert b"keeps_ending -> draw_plainly" in (folder / "state/faults").read_bytes()
    wrong = subprocess.run([PROGRAM, "--start-timeout", "x"], capture_output=True, text=True, check=False)
    assert wrong.returncode == 2 and wrong.stderr, wrong


main()
