#!/usr/bin/python3
"""A scenario through ROS, in lock step, is the scenario that `fly` flies."""
import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest

import rospy
import rostest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import PACKAGE, executable  # noqa: E402

SAME = 1e-3  # [m]


def read_csv(path):
    """Rows by column name without its unit; empty fields are None."""
    with open(path) as file:
        return [{key.split(' ')[0]: float(value) if value else None for key, value in row.items()}
                for row in csv.DictReader(file)]


class Flight(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('flight_test')
        cls.scenario = rospy.get_param('~scenario')
        cls.controller = rospy.get_param('/uav/controller/gains/law')
        cls.folder = tempfile.TemporaryDirectory()
        ros, offline = os.path.join(cls.folder.name, 'ros'), os.path.join(cls.folder.name, 'fly')
        subprocess.run([executable('mission_node'), '__ns:=uav', '_out:=' + ros, '_plots:=false'],
                       check=True, timeout=200)
        subprocess.run([executable('fly'), cls.scenario, '--controller', cls.controller, '--out',
                        offline, '--no-plots', '--json', os.path.join(offline, 'metrics.json')],
                       check=True, timeout=200)
        name = cls.controller + '.csv'
        cls.ros, cls.fly = read_csv(os.path.join(ros, name)), read_csv(os.path.join(offline, name))
        with open(os.path.join(ros, 'metrics.json')) as file:
            cls.ros_metrics = json.load(file)['flights'][0]
        with open(os.path.join(offline, 'metrics.json')) as file:
            cls.fly_metrics = json.load(file)['flights'][0]

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_no_control_step_is_missing(self):
        self.assertEqual([row['t'] for row in self.ros], [row['t'] for row in self.fly])
        rate = rospy.get_param('/uav/scenario/control_rate')
        duration = rospy.get_param('/uav/scenario/duration')
        self.assertEqual(len(self.ros), round(duration * rate))

    def test_same_path(self):
        for ros, fly in zip(self.ros, self.fly):
            for axis in 'xyz':
                self.assertLess(abs(ros[axis] - fly[axis]), SAME, 'at %g s' % fly['t'])

    def test_same_set_points_and_payload(self):
        for key in self.fly[0]:
            if key.startswith('set_') or key in ('payload_mass', 'flying'):
                for ros, fly in zip(self.ros, self.fly):
                    if fly[key] is None:
                        self.assertIsNone(ros[key], key)
                    else:
                        self.assertAlmostEqual(ros[key], fly[key], delta=1e-6,
                                               msg='%s at %g s' % (key, fly['t']))

    def test_same_metrics(self):
        for key, value in self.fly_metrics['rms'].items():
            self.assertAlmostEqual(self.ros_metrics['rms'][key], value, delta=1e-3)
        self.assertEqual(self.ros_metrics['crashed'], self.fly_metrics['crashed'])

    def test_faster_than_real_time(self):
        self.assertGreater(self.ros_metrics['real_time_factor'], 1.0)


if __name__ == '__main__':
    rostest.rosrun(PACKAGE, 'flight', Flight, sys.argv)
