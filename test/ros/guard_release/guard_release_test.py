#!/usr/bin/python3
"""A trajectory that is withdrawn is braked from, not fallen out of (BUG 7)."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Release(GuardedTest):
    def test_release(self):
        self.uav.take_off()
        self.uav.go(8.0, 0.0, 1.5)
        self.uav.wait('speed', lambda: self.uav.state.velocity.x > 1.5)
        at = self.uav.truth.x
        self.uav.obey('release')
        self.expect_holding()
        self.assertLess(self.uav.truth.x - at, 4.0)
        self.assertGreater(self.uav.truth.x, at)

if __name__ == '__main__':
    run(Release)
