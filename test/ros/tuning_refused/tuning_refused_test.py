#!/usr/bin/python3
"""A flight during which sets of gains are refused is the flight without them, bit for bit.

Both go through ROS. The flight of `fly` differs from them in the last bits: odometry tells the
velocity in the body frame, and turning it there and back rounds.
"""
import math
import os
import subprocess
import sys
import tempfile
import threading
import unittest

import rospy
import rostest
from adaptive_quadrotor_control.msg import ControllerState
from dynamic_reconfigure.client import Client
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import PACKAGE, executable  # noqa: E402

GAINS = '/uav/controller/gains'
SCENARIO, STEPS = 'aggressive_manoeuvre', 11700
MIDDLE = (5.0, 110.0)  # of the flight, where refusals count [s]


class Insister:
    """Asks for wrong gains, by both ways in turns, in a thread of its own."""

    def __init__(self):
        self.refused = {'reload': [], 'reconfigure': []}  # times of the flight [s]
        self.accepted = []
        self.time = 0.0
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.insist)

    def __enter__(self):
        rospy.wait_for_service('/uav/controller/reload_parameters', timeout=20)
        # The latest one only: the flight is faster than Python reads.
        self.subscriber = rospy.Subscriber('/uav/controller/state', ControllerState, self.take,
                                           queue_size=1)
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.over.set()
        self.thread.join()
        self.subscriber.unregister()

    def take(self, state):
        if state.flying:
            self.time = (state.header.stamp - state.trajectory_stamp).to_sec()

    def insist(self):
        reload = rospy.ServiceProxy('/uav/controller/reload_parameters', Trigger)
        client = Client('/uav/controller/tuning', timeout=20)
        rospy.set_param(GAINS + '/position/slope', [9.0, 9.0, 9.0])
        rospy.set_param(GAINS + '/mass_estimate/leak', -1.0)
        wrong = {'position_slope_x': 9.0, 'position_gain_z': math.nan}
        while not self.over.is_set():
            self.note('reload', reload().success)
            self.note('reconfigure',
                      client.update_configuration(wrong)['position_slope_x'] == 9.0)

    def note(self, way, accepted):
        (self.accepted if accepted else self.refused[way]).append(self.time)

    def count(self, way):
        return sum(MIDDLE[0] < time < MIDDLE[1] for time in self.refused[way])


def fly(folder):
    """The mission in lock step, from start to end; its CSV file."""
    subprocess.run([executable('mission_node'), '__ns:=uav', '_out:=' + folder, '_plots:=false'],
                   check=True, timeout=100, stdout=subprocess.DEVNULL)
    with open(os.path.join(folder, 'asmc.csv')) as file:
        return file.read().splitlines()


class TuningRefused(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def start(self):
        """A simulation of its own, so that both flights begin with the same bits."""
        launch = subprocess.Popen(
            ['roslaunch', PACKAGE, 'simulation.launch', 'scenario:=' + SCENARIO,
             'controller:=asmc', 'lock_step:=true', 'start_paused:=true'],
            stdout=subprocess.DEVNULL)

        def stop():
            launch.terminate()
            launch.wait()
        self.addCleanup(stop)
        return stop

    def test_refused_sets_leave_the_flight_alone(self):
        stop = self.start()
        plain = fly(os.path.join(self.folder, 'plain'))
        stop()
        self.start()
        with Insister() as insister:
            disturbed = fly(os.path.join(self.folder, 'disturbed'))

        self.assertEqual(insister.accepted, [])
        for way in insister.refused:
            self.assertGreater(insister.count(way), 3, way)
        self.assertEqual(len(plain), 1 + STEPS)
        names = plain[0].split(',')
        for before, after in zip(plain, disturbed):  # all digits: the same text is the same bits
            if before != after:
                self.fail([word for word in zip(names, before.split(','), after.split(','))
                           if word[1] != word[2]])
        self.assertEqual(len(plain), len(disturbed))


if __name__ == '__main__':
    rospy.init_node('tuning_refused_test')
    rostest.rosrun(PACKAGE, 'tuning_refused', TuningRefused, sys.argv)
