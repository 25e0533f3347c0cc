#!/usr/bin/python3
"""A flight during which sets of gains are refused is the flight without them, digit for digit."""
import os
import subprocess
import sys
import tempfile
import threading
import unittest

import rospy
import rostest
from std_srvs.srv import Trigger
from uav import PACKAGE, executable


class TuningRefused(unittest.TestCase):
    def test_refused_sets_leave_the_flight_alone(self):
        rospy.init_node('tuning_refused_test')
        rospy.wait_for_service('/uav/controller/reload_parameters', timeout=20)
        reload = rospy.ServiceProxy('/uav/controller/reload_parameters', Trigger)
        rospy.set_param('/uav/controller/gains/position/slope', [9.0, 9.0, 9.0])
        rospy.set_param('/uav/controller/gains/mass_estimate/leak', -1.0)
        answers, over = [], threading.Event()

        def insist():
            while not over.is_set():
                answers.append(reload().success)

        with tempfile.TemporaryDirectory() as folder:
            thread = threading.Thread(target=insist)
            thread.start()
            try:
                subprocess.run([executable('mission_node'), '__ns:=uav', '_out:=' + folder + '/ros',
                                '_plots:=false'], check=True, timeout=100)
            finally:
                over.set()
                thread.join()
            subprocess.run([executable('fly'), 'hover_payload', '--controller', 'asmc', '--out',
                            folder + '/fly', '--no-plots'], check=True, timeout=100)
            with open(os.path.join(folder, 'ros', 'asmc.csv')) as ros, \
                    open(os.path.join(folder, 'fly', 'asmc.csv')) as fly:
                ros_lines, fly_lines = ros.readlines(), fly.readlines()
        self.assertGreater(len(answers), 3)
        self.assertFalse(any(answers))
        self.assertEqual(len(ros_lines), len(fly_lines))
        for ours, theirs in zip(ros_lines[1:], fly_lines[1:]):
            for a, b in zip(ours.split(','), theirs.split(',')):
                if a.strip() or b.strip():
                    self.assertAlmostEqual(float(a), float(b), delta=1e-6)


if __name__ == '__main__':
    rostest.rosrun(PACKAGE, 'tuning_refused', TuningRefused, sys.argv)
