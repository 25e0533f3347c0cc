#!/usr/bin/python3
"""Without odometry the vehicle descends by its IMU and stops its rotors (BUG 6)."""
import os
import sys
import unittest

import rospy
import rostest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedUav  # noqa: E402


class Guard(unittest.TestCase):
    def setUp(self):
        rospy.init_node('guard_silence_test')
        self.uav = GuardedUav()

    def test_silence(self):
        self.uav.take_off()
        begin = self.uav.now
        self.uav.spoil = lambda message: None
        self.uav.wait_mode('emergency descent')
        self.assertEqual(self.uav.state.mode_reason, 'odometry lost')
        self.assertLess(self.uav.state.odometry_silence, 0.8)
        self.uav.wait_mode('disarmed')
        self.uav.wait('the rotors to stand still', lambda: max(
            self.uav.motors[-1].angular_velocities) == 0.0)
        self.assertFalse(self.uav.status.crashed, self.uav.status.crash_reason)
        self.assertGreater(begin, 0.0)


if __name__ == '__main__':
    rostest.rosrun('adaptive_quadrotor_control', 'guard_silence', Guard, sys.argv)
