#!/usr/bin/python3
"""Kill stops the rotors at once and for ever."""
import os
import sys
import unittest

import rospy
import rostest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedUav  # noqa: E402


class Guard(unittest.TestCase):
    def setUp(self):
        rospy.init_node('guard_kill_test')
        self.uav = GuardedUav()

    def test_kill(self):
        self.uav.take_off()
        self.uav.obey('kill')
        self.uav.wait('still rotors', lambda: max(
            self.uav.motors[-1].angular_velocities) == 0.0)
        self.uav.wait_mode('killed')  # the state is published after the rotors' command
        self.assertFalse(self.uav.order('arm').success)


if __name__ == '__main__':
    rostest.rosrun('adaptive_quadrotor_control', 'guard_kill', Guard, sys.argv)
