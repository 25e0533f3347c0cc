#!/usr/bin/python3
"""The plant's services: payload, wind, reset."""
import os
import sys
import unittest

import rospy
import rostest
from adaptive_quadrotor_control.msg import Actuators
from adaptive_quadrotor_control.srv import AttachPayload, DetachPayload, SetWind
from geometry_msgs.msg import Vector3
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import Uav  # noqa: E402


def service(name, kind):
    rospy.wait_for_service('/uav/plant/' + name, timeout=20)
    return rospy.ServiceProxy('/uav/plant/' + name, kind)


class Services(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('services_test')
        cls.uav = Uav()
        cls.uav.wait_until_ready()
        cls.attach = service('attach_payload', AttachPayload)
        cls.detach = service('detach_payload', DetachPayload)
        cls.wind = service('set_wind', SetWind)
        cls.reset = service('reset', Trigger)

    def setUp(self):
        """Without payload and wind, hovering."""
        if self.uav.status.payload_mass > 0:
            self.assertTrue(self.detach().success)
        self.wind(velocity=Vector3())
        self.uav.go(0, 0, 1.5)
        self.uav.sleep(25.0)

    def box(self, mass, at=0.0, size=0.1):
        return self.attach(at=rospy.Time.from_sec(at), mass=mass, size=Vector3(size, size, size),
                           offset=Vector3(0, 0, -0.15), inertia=Vector3())

    def test_messages_equal_those_of_mav_msgs(self):
        self.assertEqual(Actuators._md5sum, '25741daf38ed25442e3a66a855ee8d9c')

    def test_carries_a_payload_attached_at_its_time(self):
        before = len(self.uav.statuses)
        at = round(self.uav.now) + 100.0  # far enough for the call to arrive before
        response = self.box(0.5, at=at)
        self.assertTrue(response.success, response.message)
        self.uav.wait('the payload', lambda: self.uav.status.payload_mass == 0.5)
        first = next(s for s in self.uav.statuses[before:] if s.payload_mass > 0)
        self.assertAlmostEqual(first.header.stamp.to_sec(), at, delta=0.0041)
        self.uav.wait('20 s with it', lambda: self.uav.now >= at + 20.0)
        self.assertLess(self.uav.error(), 0.1)
        self.assertAlmostEqual(self.uav.state.thrust, 2.5 * 9.81, delta=0.3)

    def test_refuses_a_second_payload_and_a_senseless_one(self):
        self.assertTrue(self.box(0.5).success)
        self.uav.wait('the payload', lambda: self.uav.status.payload_mass == 0.5)
        again = self.box(0.5)
        self.assertFalse(again.success)
        self.assertIn('attached already', again.message)
        self.assertTrue(self.detach().success)
        self.uav.wait('the payload to be gone', lambda: self.uav.status.payload_mass == 0)
        nothing = self.detach()
        self.assertFalse(nothing.success)
        self.assertIn('no payload', nothing.message)
        negative = self.box(-1.0)
        self.assertFalse(negative.success)
        self.assertIn("'payload/mass' is '-1'", negative.message)
        self.assertFalse(self.box(0.5, size=0.0).success)
        self.assertEqual(self.uav.status.payload_mass, 0)

    def test_wind_pushes(self):
        self.assertFalse(self.wind(velocity=Vector3(float('nan'), 0, 0)).success)
        self.assertTrue(self.wind(velocity=Vector3(8.0, 0, 0)).success)
        self.uav.wait('the wind to push', lambda: self.uav.state.position_error.x > 0.02)

    def test_reset_puts_the_vehicle_back(self):
        before = self.uav.now
        self.assertTrue(self.reset().success)
        self.uav.wait('the vehicle back at its start',
                      lambda: any(s.position.z < 0.3 and s.header.stamp.to_sec() >= before
                                  for s in self.uav.states[-2000:]))
        self.assertGreaterEqual(self.uav.now, before)  # time goes on

    def test_resume_is_refused_while_running(self):
        response = service('resume', Trigger)()
        self.assertFalse(response.success)
        self.assertIn('running', response.message)


if __name__ == '__main__':
    rostest.rosrun('adaptive_quadrotor_control', 'services', Services, sys.argv)
