#!/usr/bin/python3
"""A set point 100 m away is flown no faster than the governor allows (BUG 4)."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Far(GuardedTest):
    def test_far(self):
        self.uav.take_off()
        first = len(self.uav.states)
        self.uav.go(100.0, 0.0, 1.5)
        self.uav.sleep(8.0)
        for state in self.uav.states[first:]:
            self.assertLess(state.velocity.x, 4.6)
            self.assertGreater(state.position.z, 0.7)
        self.assertGreater(self.uav.state.position.x, 20.0)
        self.uav.obey('hold')
        self.uav.sleep(4.0)
        self.assertLess(abs(self.uav.state.velocity.x), 0.3)
        self.assertFalse(self.uav.status.crashed)


if __name__ == '__main__':
    run(Far)
