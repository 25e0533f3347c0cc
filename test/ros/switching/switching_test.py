#!/usr/bin/python3
"""Switching by hand: what is legal happens, what is not is refused and named. And the IMU stops."""
import os
import sys
import unittest

import rospy
import rostest
from adaptive_quadrotor_control.msg import ActiveSubsystem
from sensor_msgs.msg import Imu
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import Uav  # noqa: E402

DWELL_TIME = 6.7597  # least average one of config/controller/switched.yaml [s]


class Relay:
    """From imu_raw to imu, unless it is told to be silent or to spoil the samples."""

    def __init__(self):
        self.silent = self.spoilt = False
        self.publisher = rospy.Publisher('/uav/imu', Imu, queue_size=100, tcp_nodelay=True)
        # One at a time: while it is silent the simulation races, and old samples would pile up.
        rospy.Subscriber('/uav/imu_raw', Imu, self.relay, queue_size=1, tcp_nodelay=True)

    def relay(self, sample):
        if self.spoilt:
            sample.linear_acceleration.z = float('nan')
        if not self.silent:
            self.publisher.publish(sample)


class Switching(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('switching_test')
        cls.uav = Uav()
        cls.relay = Relay()
        cls.orders = rospy.Publisher('/uav/active_subsystem', ActiveSubsystem, queue_size=10)
        cls.uav.wait_until_ready()
        cls.uav.wait('a listener', lambda: cls.orders.get_num_connections() > 0)
        cls.uav.wait('the IMU', lambda: not cls.uav.state.imu_lost)
        cls.uav.go(0, 0, 2)
        rospy.ServiceProxy('/uav/plant/resume', Trigger)()
        cls.uav.wait('the height', lambda: abs(cls.uav.state.position.z - 2.0) < 0.1)
        cls.uav.sleep(5.0)

    def setUp(self):
        """In the first subsystem."""
        if self.uav.state.active_subsystem != 1:
            self.uav.sleep(DWELL_TIME)
            self.switch(1)

    def rest(self):
        """Until it may be switched as often in a row as ever."""
        if self.uav.state.switches > 0:
            self.uav.sleep(4.0 * DWELL_TIME)

    def order(self, subsystem, at=0.0):
        message = ActiveSubsystem(subsystem=subsystem)
        message.header.stamp = rospy.Time.from_sec(at)
        self.orders.publish(message)

    def switch(self, subsystem):
        self.order(subsystem)
        self.uav.wait('subsystem %d' % subsystem,
                      lambda: self.uav.state.active_subsystem == subsystem)

    def refused(self, subsystem):
        """The state that tells of the refusal."""
        before = self.uav.state.switch_refusals
        self.order(subsystem)
        self.uav.wait('a refusal', lambda: self.uav.state.switch_refusals == before + 1)
        state = next(s for s in self.uav.states if s.switch_refusals == before + 1)
        self.assertEqual(state.refused_subsystem, subsystem)
        return state

    def test_legal_switches_happen(self):
        self.rest()
        before = self.uav.state
        self.switch(2)
        self.switch(3)
        self.switch(1)
        self.assertEqual(self.uav.state.switches, before.switches + 3)
        self.assertEqual(self.uav.state.switch_refusals, before.switch_refusals)

    def test_too_early_is_refused_until_the_time_it_names(self):
        self.rest()
        before = self.uav.state
        for subsystem in (2, 3, 1):
            self.switch(subsystem)
        state = self.refused(3)
        self.assertIn('dwell time', state.switch_refusal)
        self.assertEqual(state.active_subsystem, 1)
        allowed, now = state.next_switch_allowed.to_sec(), state.header.stamp.to_sec()
        self.assertTrue(now < allowed <= now + DWELL_TIME, (now, allowed))
        self.order(3, at=allowed)
        self.uav.wait('the order to be kept', lambda: self.uav.state.switches_pending == 1)
        self.uav.wait('its time', lambda: self.uav.state.active_subsystem == 3)
        acted = next(s for s in self.uav.states if s.switches == before.switches + 4).header.stamp.to_sec()
        self.assertTrue(allowed <= acted < allowed + 0.0041, (allowed, acted))
        self.assertEqual(self.uav.state.switch_refusals, before.switch_refusals + 1)

    def test_an_unknown_subsystem_is_refused(self):
        for subsystem in (0, 4):
            state = self.refused(subsystem)
            self.assertIn('no such subsystem', state.switch_refusal)
            self.assertEqual(state.active_subsystem, 1)

    def test_an_imu_that_stops_is_told_and_the_flight_goes_on(self):
        losses = self.uav.state.imu_losses
        self.addCleanup(setattr, self.relay, 'silent', False)
        self.relay.silent = True
        self.uav.wait('the loss to be noticed', lambda: self.uav.state.imu_lost)
        self.assertEqual(self.uav.state.imu_losses, losses + 1)
        before = len(self.uav.states)
        self.uav.sleep(5.0)
        self.assertTrue(self.uav.state.imu_lost)
        self.assertLess(max(abs(s.position_error.z) for s in self.uav.states[before:]), 0.1)
        self.relay.silent = False
        self.uav.wait('the IMU to be back', lambda: not self.uav.state.imu_lost)
        self.assertEqual(self.uav.state.imu_losses, losses + 1)

    def test_samples_that_are_not_finite_are_dropped_and_counted(self):
        before = self.uav.state.dropped_imu
        self.addCleanup(setattr, self.relay, 'spoilt', False)
        self.relay.spoilt = True
        self.uav.wait('dropped samples', lambda: self.uav.state.dropped_imu > before + 3)
        self.relay.spoilt = False
        self.uav.sleep(1.0)
        self.assertFalse(self.uav.state.imu_lost)
        self.assertLess(abs(self.uav.state.position_error.z), 0.1)


if __name__ == '__main__':
    rostest.rosrun('adaptive_quadrotor_control', 'switching', Switching, sys.argv)
