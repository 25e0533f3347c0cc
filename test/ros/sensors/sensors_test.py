#!/usr/bin/python3
"""The plant node's odometry has the scenario's rate and noise, and lock step goes on over its gaps;
that it is the offline flight's is told by flight.test with noisy.yaml. How late it comes cannot be
seen from here: in lock step messages of different topics arrive in bunches."""
import os
import sys
import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import PACKAGE, Uav  # noqa: E402


class Sensors(unittest.TestCase):
    def test_rate_delay_noise_and_gap(self):
        rospy.init_node('sensors_test')
        uav = Uav()
        heard = []  # stamp, height
        rospy.Subscriber('/uav/odometry', Odometry, lambda message: heard.append(
            (message.header.stamp.to_sec(), message.pose.pose.position.z)), tcp_nodelay=True)
        uav.wait('10 s of the plant', lambda: uav.statuses and
                 uav.status.header.stamp.to_sec() > 10.0)
        heard = [message for message in heard if message[0] > 4.5]  # behind the gap
        steps = [round(b[0] - a[0], 6) for a, b in zip(heard, heard[1:])]
        self.assertEqual(set(steps), {0.02})
        heights = [height for _, height in heard]
        mean = sum(heights) / len(heights)
        deviation = (sum((z - mean) ** 2 for z in heights) / len(heights)) ** 0.5
        self.assertAlmostEqual(mean, 0.1, delta=0.01)
        self.assertAlmostEqual(deviation, 0.01, delta=0.003)


if __name__ == '__main__':
    rostest.rosrun(PACKAGE, 'sensors', Sensors, sys.argv)
