"""Measures the memory of the whole system while the exhibit runs.

Units    MB, 10^6 bytes.
"""

import re

LIMIT_MB = 350.0
# "NAME KIB" for each process: its own memory and its share of common pages (PSS). The kernel's own processes have no such line.
ROLLUP = "for p in /proc/[0-9]*; do echo $(cat $p/comm) $(sed -n 's/^Pss: *\\([0-9]*\\) kB/\\1/p' $p/smaps_rollup 2>/dev/null); done"


def test_overlay_mb(pc):
    """The memory that only a test's image takes: its agent, and its files in memory."""
    processes = [line.split() for line in pc.run(ROLLUP).output.splitlines()]
    agent = sum(int(words[1]) for words in processes if len(words) == 2 and words[0] == "qemu-ga")
    files = int(pc.check("df -k /run/extra | sed -n '2s/  */ /gp'").split()[2])
    return (agent + files) * 1024 / 1e6


def used_mb(pc):
    """MemTotal - MemAvailable, without the test's share. The kernel counts half of the cached files, and a reserve, as not available."""
    found = dict(re.findall(r"^(\w+): +(\d+)", pc.read("/proc/meminfo"), re.M))
    return (int(found["MemTotal"]) - int(found["MemAvailable"])) * 1024 / 1e6 - test_overlay_mb(pc)
