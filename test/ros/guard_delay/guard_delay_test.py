#!/usr/bin/python3
"""Odometry that comes 20 ms late, the delay that the tuning document promises to bear (BUG 11)."""
import collections
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402

DELAY = 5  # messages, of 4 ms


class Delay(GuardedTest):
    def test_delay(self):
        waiting = collections.deque()

        def later(message):
            waiting.append(message)
            return waiting.popleft() if len(waiting) > DELAY else None
        self.uav.spoil = later
        self.uav.take_off()
        self.assertTrue(self.uav.go_to(2.0, 0.0, 1.2).success)
        self.uav.sleep(5.0)
        self.expect_holding()
        self.assertAlmostEqual(self.uav.truth.x, 2.0, delta=0.15)
        self.assertLess(self.uav.state.dropped_odometry, 25)  # a tenth of a second


if __name__ == '__main__':
    run(Delay)
