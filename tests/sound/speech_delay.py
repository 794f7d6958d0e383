#!/usr/bin/python3
"""Measures the time from a press to the beginning of speech, in real time: a script presses, and the first sample of sound is found.

    tests/sound/speech_delay.py BIN PACK... [--presses N]    BIN: the folder of frustumscreen; PACK: has a spoken description

A thread reads the recordings, as on a kiosk. The sound goes into a file: a sound card adds its own ring buffer, 50 ms at most.
"""

import argparse
import array
import pathlib
import subprocess
import tempfile
import wave

FIRST_S = 4.0
APART_S = 3.0137  # between presses; not a multiple of a frame, so that each press comes at another place between two frames
TALKS_S = 1.3  # after this time a second press asks for something silent

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("bin", type=pathlib.Path)
parser.add_argument("packs", nargs="+", type=pathlib.Path)
parser.add_argument("--presses", type=int, default=20)
arguments = parser.parse_args()
asked = [FIRST_S + APART_S * k for k in range(arguments.presses)]
script = sorted([(at, 4) for at in asked] + [(at + TALKS_S, 3) for at in asked])

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    poses = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n0,1,0,0,0,1,0,0,0,1\n"
    (folder / "poses.csv").write_text(poses)
    presses = ", ".join(f"{{ at_s = {at}, button = {button} }}" for at, button in script)
    packs = ", ".join(f'"{pack.resolve()}"' for pack in arguments.packs)
    (folder / "kiosk.toml").write_text(
        "[projector]\nwidth = 640\nheight = 400\nthrow_ratio = 1.875\n[tracker]\nkind = \"none\"\n"
        f"[panel]\nscript = [{presses}]\n[exhibit]\npacks = [{packs}]\nguidance = false\n")
    subprocess.run([arguments.bin / "frustumscreen", "run", "--config", folder / "kiosk.toml", "--headless", "--seconds",
                    str(asked[-1] + APART_S), "--stills", "0", "--out", folder / "out"], check=True)
    with wave.open(str(folder / "out/sound.wav")) as file:
        rate = file.getframerate()
        samples = array.array("h", file.readframes(file.getnframes()))

delays_ms = []
for at in asked:
    begin = round(at * rate)
    heard = next((k for k in range(begin, min(begin + rate, len(samples))) if samples[k] != 0), None)
    if begin > 0 and any(samples[begin - rate // 10:begin]):
        print(f"  at {at:.1f} s something is still heard: left out")
    elif heard is None:
        print(f"  at {at:.1f} s nothing is heard within a second")
    else:
        delays_ms.append(1e3 * (heard - begin) / rate)
delays_ms.sort()
if delays_ms:
    count = len(delays_ms)
    print(f"{count} of {len(asked)} presses heard: median {delays_ms[count // 2]:.0f} ms, "
          f"95th percentile {delays_ms[min(count - 1, int(0.95 * count))]:.0f} ms, most {delays_ms[-1]:.0f} ms")
