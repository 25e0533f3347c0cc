#!/usr/bin/python3
"""0.3 s without odometry in motion are flown by dead reckoning, in the same mode."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Gap(GuardedTest):
    def test_gap(self):
        self.uav.take_off()
        self.uav.go(4.0, 0.0, 1.5)
        self.uav.wait('speed', lambda: self.uav.state.velocity.x > 0.8)
        self.uav.spoil = lambda message: None
        self.uav.sleep(0.3)
        self.assertEqual(self.uav.state.mode_reason, 'odometry late')
        self.uav.spoil = lambda message: message
        self.uav.sleep(8.0)
        self.assertEqual(self.uav.state.mode, 'flying')
        self.assertAlmostEqual(self.uav.truth.x, 4.0, delta=0.1)
        self.assertFalse(self.uav.status.crashed)

if __name__ == '__main__':
    run(Gap)
