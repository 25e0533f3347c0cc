#!/usr/bin/python3
"""With auto_arm a set point is all that is needed; without odometry it does nothing."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class AutoArm(GuardedTest):
    def test_auto_arm(self):
        self.uav.wait_until_ready()
        self.uav.spoil = lambda message: None
        self.uav.sleep(1.0)
        self.uav.go(0.0, 0.0, 1.5)
        self.uav.sleep(1.0)
        self.assertEqual(self.uav.state.mode, 'disarmed', 'nobody knows where it is')
        self.uav.spoil = lambda message: message
        self.uav.wait_mode('flying')
        self.uav.sleep(5.0)
        self.assertAlmostEqual(self.uav.truth.z, 1.5, delta=0.1)
        self.assertFalse(self.uav.status.crashed)

if __name__ == '__main__':
    run(AutoArm)
