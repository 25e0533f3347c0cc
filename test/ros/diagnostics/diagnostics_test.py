#!/usr/bin/python3
"""Diagnostics change under real faults: a payload too heavy, a simulator that stops, a new clock."""
import contextlib
import os
import signal
import sys
import unittest
from xmlrpc.client import ServerProxy

import rosgraph
import rospy
import rostest
from adaptive_quadrotor_control.srv import AttachPayload
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Vector3
from nav_msgs.msg import Odometry

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import PACKAGE, Uav, odometry  # noqa: E402

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


class Diagnostics(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('diagnostics_test')
        cls.uav = Uav()
        cls.found = {}
        rospy.Subscriber('/diagnostics', DiagnosticArray, cls.take)
        cls.uav.wait_until_ready()

    @classmethod
    def take(cls, message):
        with cls.uav.changed:
            for status in message.status:
                if 'controller: ' in status.name:
                    cls.found[status.name.split(': ')[1]] = status
            cls.uav.changed.notify_all()

    def expect(self, name, levels, words=''):
        self.uav.wait('%s to be one of %s: %s; last: %s' % (name, levels, words, self.found),
                      lambda: name in self.found and self.found[name].level in levels and
                      words in self.found[name].message)

    def test_1_all_is_well_at_hover(self):
        self.uav.go(0, 0, 2.0)
        self.uav.sleep(10.0)
        for name in ('Control loop', 'Odometry', 'Set point', 'Rotors', 'Messages', 'Payload'):
            self.expect(name, [OK])

    def test_2_a_payload_that_is_too_heavy(self):
        rospy.wait_for_service('/uav/plant/attach_payload', timeout=20)
        attach = rospy.ServiceProxy('/uav/plant/attach_payload', AttachPayload)
        self.assertTrue(attach(mass=2.3, size=Vector3(0.1, 0.1, 0.1),
                               offset=Vector3(0, 0, -0.15)).success)
        self.expect('Payload', [ERROR], 'kg lift')
        self.expect('Rotors', [WARN, ERROR], 'at a limit')

    def test_3_a_simulator_that_stands_still(self):
        with self.frozen_plant():
            self.expect('Odometry', [ERROR], 'flies blind')
            self.expect('Control loop', [ERROR], 'stands still')
        self.expect('Odometry', [OK])

    def test_4_a_late_message_and_a_clock_that_begins_anew(self):
        publisher = rospy.Publisher('/uav/odometry', Odometry, queue_size=100)
        self.uav.wait('a connection', lambda: publisher.get_num_connections() > 0)
        self.expect('Messages', [OK])
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
    rostest.rosrun(PACKAGE, 'diagnostics', Diagnostics, sys.argv)
