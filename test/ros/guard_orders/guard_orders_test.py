#!/usr/bin/python3
"""Every order of the guard, obeyed where it makes sense and refused elsewhere."""
import os
import sys
import unittest

import rospy
import rostest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedUav  # noqa: E402


class Guard(unittest.TestCase):
    def setUp(self):
        rospy.init_node('guard_orders_test')
        self.uav = GuardedUav()

    def test_orders(self):
        self.uav.wait_until_ready()
        self.uav.wait('odometry', lambda: self.uav.state.odometry_silence < 0.1)
        self.assertEqual(self.uav.state.mode, 'disarmed')
        for order in ('take_off', 'land', 'hold'):
            self.assertFalse(self.uav.order(order).success)
        self.uav.go(0.0, 0.0, 1.5)
        self.uav.sleep(1.0)
        self.assertEqual(self.uav.state.mode, 'disarmed', 'nobody asked')
        self.uav.take_off()
        self.assertFalse(self.uav.order('disarm').success)
        self.assertFalse(self.uav.order('arm').success)
        self.assertTrue(self.uav.go_to(1.0, 0.0, 1.2).success)
        self.assertFalse(self.uav.go_to(float('nan'), 0.0, 1.2).success)
        self.uav.sleep(6.0)
        self.assertAlmostEqual(self.uav.state.position.x, 1.0, delta=0.1)
        self.uav.obey('land')
        self.uav.expect_landed(self)


if __name__ == '__main__':
    rostest.rosrun('adaptive_quadrotor_control', 'guard_orders', Guard, sys.argv)
