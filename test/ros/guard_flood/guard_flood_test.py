#!/usr/bin/python3
"""A trajectory that declares 20 million points costs the loop nothing (BUG 15)."""
import os
import struct
import sys

import rospy
from trajectory_msgs.msg import MultiDOFJointTrajectory

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Declared(MultiDOFJointTrajectory):
    """24 bytes: an empty header, no names, and more points than there are."""

    def serialize(self, buff):
        buff.write(struct.pack('<IIIIII', 0, 0, 0, 0, 0, 20000000))


class Flood(GuardedTest):
    def test_flood(self):
        self.uav.take_off()
        publisher = rospy.Publisher('/uav/command/trajectory', Declared, queue_size=1)
        self.uav.wait('the connection', lambda: publisher.get_num_connections() > 0)
        before, first = self.uav.state.dropped_set_points, len(self.uav.motors)
        publisher.publish(Declared())
        self.uav.wait('the refusal', lambda: self.uav.state.dropped_set_points > before)
        self.uav.sleep(2.0)
        stamps = [motors.header.stamp.to_sec() for motors in self.uav.motors[first:]]
        # Unpacking the points took 3.8 s; a busy machine alone was seen to pause for 0.14 s.
        self.assertLess(max(b - a for a, b in zip(stamps, stamps[1:])), 0.5)
        self.expect_holding()

if __name__ == '__main__':
    run(Flood)
