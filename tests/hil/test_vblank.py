"""Tests that the exhibit's frames follow the flips of a card with real vblanks and a slow modeset, as some projectors have.

The card is the kernel's virtual display (guest_vkms.sh), which no window shows; the status file has the number of frames. The settings'
30 Hz are not a whole fraction of the forced refresh rate. So a frame begins at every second flip, 25 times a second, if flips are followed,
and 30 times a second if they are not.
"""


from bench import USUAL, eventually
from hil_test import HilTest, long

CARD = "/dev/dri/by-path/platform-vkms-card"
REFRESH_HZ = 50
FOLLOWED_HZ, FREE_HZ = 25.0, 30.0
MODESET_MS = 200
MEASURED_S = 8.0
MAX_SKIPPED = 0.1  # they are counted in periods of the settings' rate, also if flips are followed


@long
class Vblanks(HilTest):
    unsigned = True
    settings = f'{USUAL}\n[display]\ncard = "{CARD}"\nmode = "640x400@{REFRESH_HZ}"\nforce = true\n'
    before = f"modprobe -a drm_shmem_helper drm_kms_helper; insmod /usr/lib/frustumscreen/vkms.ko modeset_ms={MODESET_MS}"
    after = "rmmod vkms"

    def test_frames_follow_flips_after_a_slow_modeset(self):
        def measured():
            """The status before and after a while in which the guest skipped few frames."""
            before = self.bench.status()
            self.bench.machine.let_run(MEASURED_S)
            after = self.bench.status()
            skipped, drawn = (after[key] - before[key] for key in ("skipped", "frames"))
            return (before, after) if skipped < MAX_SKIPPED * drawn else None

        before, after = eventually(measured, 5 * MEASURED_S, "the guest skips too many frames to judge")
        frames, seconds = (sum(status[key] * sign for status, sign in ((after, 1), (before, -1)) for key in keys)
                           for keys in (("frames", "skipped"), ("uptime_s",)))
        print(f"  {frames / seconds:.1f} frames a second", flush=True)
        self.assertLess(frames / seconds, 0.5 * (FOLLOWED_HZ + FREE_HZ), "frames run free of the display's flips")
