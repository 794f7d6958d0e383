"""The memory that the whole system takes while the exhibit runs.

Units    MB, 10^6 bytes.
"""

import re

LIMIT_MB = 350.0
# The tests' picture is 640 x 400 pixels, a kiosk's 1920 x 1200. What the exhibit takes more for that was measured on a PC, drawing by
# the processor as here (image_build/README.md, Memory): 199.0 - 49.3 MiB of its own.
LARGER_PICTURE_MB = 157.0
ROLLUP = "for p in /proc/[0-9]*; do [ ! -s $p/smaps_rollup ] || echo $(cat $p/comm) $(sed -n 's/^Pss: *\\([0-9]*\\) kB/\\1/p' $p/smaps_rollup); done"


def test_overlay_mb(pc):
    """What the test's image takes besides: its agent, and its files in memory."""
    agent = sum(int(line.split()[-1]) for line in pc.check(ROLLUP).splitlines() if line.startswith("qemu-ga "))
    files = int(pc.check("df -k /run/extra | sed -n '2s/  */ /gp'").split()[2])
    return (agent + files) * 1024 / 1e6


def used_mb(pc):
    """MemTotal - MemAvailable, without the test's share: all but what the kernel can give back at once, such as files it keeps."""
    found = dict(re.findall(r"^(\w+): +(\d+)", pc.read("/proc/meminfo"), re.M))
    return (int(found["MemTotal"]) - int(found["MemAvailable"])) * 1024 / 1e6 - test_overlay_mb(pc)
