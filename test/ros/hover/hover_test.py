#!/usr/bin/python3
"""Hover by pose commands: rotors still before, on the spot afterwards, garbage ignored."""
import os
import sys
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import Uav, odometry  # noqa: E402


class Hover(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('hover_test')
        cls.uav = Uav()
        cls.uav.wait_until_ready()
        cls.uav.sleep(1.0)
        cls.waiting, cls.still = cls.uav.state, list(cls.uav.motors)
        cls.uav.go(0.5, -0.5, 1.0, yaw=0.4)
        cls.uav.sleep(25.0)

    def test_rotors_stand_still_before_the_first_set_point(self):
        self.assertFalse(self.waiting.flying)
        for command in self.still:
            self.assertEqual(list(command.angular_velocities), [0.0] * 4)
        self.assertAlmostEqual(self.waiting.position.z, 0.1, delta=1e-3)

    def test_hovers_where_a_pose_says(self):
        self.assertLess(self.uav.error(), 0.05)
        self.assertAlmostEqual(self.uav.state.desired_yaw, 0.4, places=6)
        self.assertLess(abs(self.uav.state.attitude_error.z), 0.02)
        self.assertAlmostEqual(self.uav.state.thrust, 2.0 * 9.81, delta=0.2)
        self.assertTrue(all(speed > 400 for speed in self.uav.motors[-1].angular_velocities))

    def test_refuses_poses_that_are_none(self):
        before = self.uav.state
        publisher = rospy.Publisher('/uav/command/pose', PoseStamped, queue_size=1)
        self.uav.wait('a connection', lambda: publisher.get_num_connections() > 0)
        bad = PoseStamped()
        bad.pose.position.x = float('nan')
        bad.pose.orientation.w = 1.0
        publisher.publish(bad)
        self.uav.wait('the refusal', lambda: self.uav.state.dropped_set_points ==
                      before.dropped_set_points + 1)
        publisher.publish(PoseStamped())  # a quaternion of zeros
        self.uav.wait('the refusal', lambda: self.uav.state.dropped_set_points ==
                      before.dropped_set_points + 2)
        self.assertEqual(self.uav.state.desired_position, before.desired_position)

    def test_refuses_odometry_that_is_none(self):
        before = self.uav.state
        publisher = rospy.Publisher('/uav/odometry', Odometry, queue_size=10)
        self.uav.wait('a connection', lambda: publisher.get_num_connections() > 0)
        bad = odometry(rospy.Time.now().to_sec())
        bad.twist.twist.linear.z = float('inf')
        publisher.publish(bad)
        self.uav.wait('the refusal', lambda: self.uav.state.dropped_odometry ==
                      before.dropped_odometry + 1)
        self.uav.sleep(1.0)
        self.assertLess(self.uav.error(), 0.05)

    def test_one_message_of_another_time_does_not_end_the_flight(self):
        publisher = rospy.Publisher('/uav/odometry', Odometry, queue_size=10)
        self.uav.wait('a connection', lambda: publisher.get_num_connections() > 0)
        before = len(self.uav.states)
        publisher.publish(odometry(0.5))
        self.uav.wait('the refusal', lambda: self.uav.state.dropped_odometry ==
                      self.uav.states[before - 1].dropped_odometry + 1)
        self.uav.sleep(1.0)
        self.assertTrue(all(state.flying for state in self.uav.states[before:]))
        self.assertLess(self.uav.error(), 0.05)


if __name__ == '__main__':
    rostest.rosrun('adaptive_quadrotor_control', 'hover', Hover, sys.argv)
