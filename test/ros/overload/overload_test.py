#!/usr/bin/python3
"""A payload that the rotors cannot lift: diagnostics say so."""
import os
import sys
import unittest

import rospy
import rostest
from adaptive_quadrotor_control.srv import AttachPayload
from geometry_msgs.msg import Vector3

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import ERROR, OK, PACKAGE, WARN, Diagnostics, Uav  # noqa: E402


class Overload(unittest.TestCase):
    def test_a_payload_that_is_too_heavy(self):
        rospy.init_node('overload_test')
        uav = Uav()
        diagnostics = Diagnostics(uav)
        uav.wait_until_ready()
        uav.go(0, 0, 2.0)
        uav.sleep(10.0)
        for name in ('Payload', 'Rotors'):
            diagnostics.expect(name, [OK])
        rospy.wait_for_service('/uav/plant/attach_payload', timeout=20)
        attach = rospy.ServiceProxy('/uav/plant/attach_payload', AttachPayload)
        self.assertTrue(attach(mass=2.3, size=Vector3(0.1, 0.1, 0.1),
                               offset=Vector3(0, 0, -0.15)).success)
        diagnostics.expect('Payload', [ERROR], 'too heavy')
        diagnostics.expect('Rotors', [WARN, ERROR], 'at a limit')


if __name__ == '__main__':
    rostest.rosrun(PACKAGE, 'overload', Overload, sys.argv)
