#!/usr/bin/python3
"""A vehicle that is held down learns nothing and gives up (BUG 3)."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Tether(GuardedTest):
    def test_tether(self):
        self.uav.wait_until_ready()
        self.uav.wait('odometry', lambda: self.uav.state.odometry_silence < 0.1)
        self.uav.push(10.0, force=(0.0, 0.0, -100.0))
        self.uav.sleep(0.5)
        first = len(self.uav.states)
        self.uav.obey('arm')
        self.uav.obey('take_off')
        begin = self.uav.now
        self.uav.wait_mode('disarmed')
        self.assertEqual(self.uav.state.mode_reason, 'no lift-off')
        self.assertLess(self.uav.now - begin, 7.0)
        for state in self.uav.states[first:]:
            self.assertLess(state.mass_estimate, 4.2, 'more than the rotors lift')
        self.uav.sleep(5.0)
        self.uav.take_off()
        self.assertLess(max(state.position.z for state in self.uav.states), 1.5)
        self.expect_holding()

if __name__ == '__main__':
    run(Tether)
