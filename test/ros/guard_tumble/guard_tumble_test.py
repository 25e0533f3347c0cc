#!/usr/bin/python3
"""A vehicle that is thrown on its back stops its rotors (BUG 7)."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Tumble(GuardedTest):
    def test_tumble(self):
        self.uav.take_off()
        first = len(self.uav.motors)
        self.uav.push(0.4, moment=(8.0, 0.0, 0.0))
        self.uav.wait_mode('disarmed')
        self.assertIn(self.uav.state.mode_reason, ('tumble', 'tipped over'))
        self.uav.wait('still rotors', lambda: max(
            self.uav.motors[-1].angular_velocities) == 0.0)
        self.uav.go(0.0, 0.0, 1.5)
        self.uav.sleep(1.0)
        self.assertEqual(max(self.uav.motors[-1].angular_velocities), 0.0, 'not by itself again')
        self.assertGreater(len(self.uav.motors), first)

if __name__ == '__main__':
    run(Tumble)
