#!/usr/bin/python3
"""Rotors whose controller fell silent are switched off, and turn again when commands come."""
import sys
import threading
import time
import unittest

import rospy
import rostest
from adaptive_quadrotor_control.msg import Actuators, PlantStatus

SPEED = 200.0  # the vehicle stays on the ground [rad/s]


class CommandTimeout(unittest.TestCase):
    def setUp(self):
        rospy.init_node('command_timeout_test')
        self.changed = threading.Condition()
        self.status = None
        self.motors = rospy.Publisher('/uav/command/motor_speed', Actuators, queue_size=1)
        rospy.Subscriber('/uav/plant/status', PlantStatus, self.take)

    def take(self, status):
        with self.changed:
            self.status = status
            self.changed.notify_all()

    def wait(self, what, condition, meanwhile=lambda: None):
        """The first status for which condition() holds; meanwhile() runs at 50 Hz."""
        deadline = time.monotonic() + 30.0
        while time.monotonic() < deadline:
            meanwhile()
            with self.changed:
                if self.changed.wait_for(lambda: self.status and condition(), 0.02):
                    return self.status
        self.fail('waited in vain for ' + what)

    def command(self):
        self.motors.publish(angular_velocities=[SPEED] * 4)

    def turn(self):
        return self.wait('turning rotors', lambda: not self.status.commands_timed_out and
                         min(self.status.rotor_speeds) > 0.98 * SPEED, self.command)

    def test_switches_the_rotors_off_until_the_next_command(self):
        turning = self.turn()
        silent = self.wait('the time-out', lambda: self.status.commands_timed_out)
        # The last command came at most a period of 0.01 s and one of 50 Hz before.
        self.assertGreater((silent.header.stamp - turning.header.stamp).to_sec(), 0.2)
        self.wait('still rotors', lambda: max(self.status.rotor_speeds) < 0.01 * SPEED)
        self.turn()


if __name__ == '__main__':
    rostest.rosrun('adaptive_quadrotor_control', 'command_timeout', CommandTimeout, sys.argv)
