#!/usr/bin/python3
"""A set point below the ground is approached, not fallen to (BUG 4)."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Floor(GuardedTest):
    def test_floor(self):
        self.uav.take_off()
        self.uav.go(0.0, 0.0, 3.0)
        self.uav.wait('3 m', lambda: self.uav.truth.z > 2.8)
        first = len(self.uav.states)
        self.uav.go(0.0, 0.0, -5.0)
        self.uav.wait('the way down', lambda: self.uav.truth.z < 0.4)
        self.uav.sleep(3.0)
        self.assertLess(-min(state.velocity.z for state in self.uav.states[first:]), 2.5)
        self.assertGreater(min(state.desired_position.z for state in self.uav.states[first:]),
                           -0.05)
        self.assertFalse(self.uav.status.crashed, self.uav.status.crash_reason)

if __name__ == '__main__':
    run(Floor)
