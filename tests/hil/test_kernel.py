"""Tests, after all other tests, that the guest's kernel has reported no fault."""

from hil_test import HilTest

COMPLAINTS = "BUG:|Oops|soft lockup|blocked for more than|general protection"


class Kernel(HilTest):
    def test_no_complaints(self):
        found = self.bench.machine.run(f"dmesg | grep -E '{COMPLAINTS}'").output
        self.assertEqual(found, "", "the exhibit has met a fault of the kernel, or caused one")
