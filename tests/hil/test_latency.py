"""Measures and reports the time from the tracker's packet to the picture on the screen; there is no limit."""

import json
import statistics
import time

import screen
from bench import UPRIGHT, Patience
from hil_test import CENTRE_M, HilTest

STEPS = 20
STEP_M = 0.01
MOVED_PX = 2.0
GIVE_UP_S = 5.0


class Latency(HilTest):
    def test_packet_to_picture(self):
        latencies_ms, looks_ms, place_m = [], [], CENTRE_M
        for number in range(STEPS):
            before = screen.centroid(screen.lit(self.bench.picture_of((*place_m, *UPRIGHT))), self.bench.machine.width)
            place_m = (STEP_M * (1 + number % 2), 0.0, 0.0)
            self.bench.place(place_m)
            deadline = Patience.clock() + GIVE_UP_S * Patience.factor
            while True:
                begin = time.monotonic()
                picture = self.bench.screendump()
                seen = time.monotonic()
                at = screen.centroid(screen.lit(picture), picture.width)
                if at is not None and abs(at[0] - before[0]) > MOVED_PX:
                    break
                self.assertLess(Patience.clock(), deadline, "the picture does not follow the tracker")
            sent = self.bench.tracker.tell("status")["changed"]["t_ns"] * 1e-9
            latencies_ms.append(1e3 * (seen - sent))
            looks_ms.append(1e3 * (seen - begin))
        frame_ms = self.bench.status()["frame_ms"]["p50"]
        found = {
            "steps": STEPS,
            "packet_to_picture_ms": {"p50": round(statistics.median(latencies_ms), 1),
                                     "p95": round(sorted(latencies_ms)[int(0.95 * STEPS)], 1),
                                     "least": round(min(latencies_ms), 1), "most": round(max(latencies_ms), 1)},
            "of_that_looking_ms": round(statistics.median(looks_ms), 1),
            "frame_ms_p50": frame_ms,
        }
        (self.bench.out / "latency.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
        print(f"  packet to picture: median {found['packet_to_picture_ms']['p50']} ms, "
              f"95th percentile {found['packet_to_picture_ms']['p95']} ms; a frame takes {frame_ms} ms", flush=True)
