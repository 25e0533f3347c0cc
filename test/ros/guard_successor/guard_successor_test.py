#!/usr/bin/python3
"""A second controller on the same rotors does not start (BUG 8)."""
import os
import subprocess
import sys

import rospy

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import PACKAGE, GuardedTest, run  # noqa: E402


class Successor(GuardedTest):
    def test_successor(self):
        self.uav.take_off()
        for name, value in rospy.get_param('/uav/controller').items():
            rospy.set_param('/uav/second/' + name, value)
        second = subprocess.run(
            ['rosrun', 'nodelet', 'nodelet', 'standalone',
             PACKAGE + '/Controller', '__name:=second', '__ns:=/uav', 'odometry:=heard'],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, timeout=30)
        self.assertNotEqual(second.returncode, 0)
        self.assertIn("'/uav/controller' publishes '/uav/command/motor_speed' already",
                      second.stdout)
        self.expect_holding()

if __name__ == '__main__':
    run(Successor)
