#!/usr/bin/python3
"""Odometry at 50 Hz is enough for a step of a metre."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Slow(GuardedTest):
    def test_slow(self):
        self.uav.take_off()
        count = [0]

        def each_fifth(message):
            count[0] += 1
            return message if count[0] % 5 == 0 else None
        self.uav.spoil = each_fifth
        self.assertTrue(self.uav.go_to(1.0, 0.0, 1.2).success)
        self.uav.sleep(4.0)
        self.expect_holding()
        self.assertAlmostEqual(self.uav.truth.x, 1.0, delta=0.15)

if __name__ == '__main__':
    run(Slow)
