#!/usr/bin/python3
"""Diagnostics change under real faults: a simulator that stops, a late message, a new clock."""
import contextlib
import os
import signal
import sys
import unittest
from xmlrpc.client import ServerProxy

import rosgraph
import rospy
import rostest
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import ERROR, OK, PACKAGE, WARN, Diagnostics, Uav, odometry  # noqa: E402


class Faults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('diagnostics_test')
        cls.uav = Uav()
        cls.expect = Diagnostics(cls.uav).expect
        cls.uav.wait_until_ready()

    def setUp(self):
        """Hovering, and all is well. One of the tests ends in a fall."""
        if self.uav.status.crashed:
            rospy.ServiceProxy('/uav/plant/reset', Trigger)()
            self.uav.wait('a new start', lambda: not self.uav.status.crashed)
        self.uav.go(0, 0, 2.0)
        self.uav.wait('the hover', lambda: self.uav.error() < 0.1)
        for name in ('Control loop', 'Odometry', 'Set point', 'Rotors', 'Messages', 'Payload'):
            self.expect(name, [OK])

    def test_a_simulator_that_stands_still(self):
        with self.frozen_plant():
            self.expect('Odometry', [ERROR], 'flies blind')
            self.expect('Control loop', [ERROR], 'stands still')
        self.expect('Odometry', [OK])

    def test_a_late_message_and_a_clock_that_begins_anew(self):
        publisher = rospy.Publisher('/uav/odometry', Odometry, queue_size=100)
        self.uav.wait('a connection', lambda: publisher.get_num_connections() > 0)
        publisher.publish(odometry(self.uav.now - 0.3))
        self.expect('Messages', [WARN], 'refused 1 of odometry')
        self.assertTrue(self.uav.state.flying)
        with self.frozen_plant():
            for _ in range(20):
                publisher.publish(odometry(1.0))
            self.expect('Messages', [WARN], 'began anew')
            self.uav.wait('a state of the new time', lambda: self.uav.now == 1.0)
            self.assertFalse(self.uav.state.flying)
            self.assertEqual(list(self.uav.motors[-1].angular_velocities), [0.0] * 4)
            self.assertEqual(self.uav.state.adaptive_values, self.uav.states[0].adaptive_values)
        self.expect('Messages', [OK])
        self.uav.go(0, 0, 2.0)
        self.uav.wait('the rotors to turn', lambda: self.uav.state.flying)

    @contextlib.contextmanager
    def frozen_plant(self):
        _, _, pid = ServerProxy(rosgraph.Master('/test').lookupNode('/uav/plant')).getPid('/test')
        os.kill(pid, signal.SIGSTOP)
        try:
            yield
        finally:
            os.kill(pid, signal.SIGCONT)


if __name__ == '__main__':
    rostest.rosrun(PACKAGE, 'diagnostics', Faults, sys.argv)
