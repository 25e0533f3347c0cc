#!/usr/bin/python3
"""Odometry and poses of other frames are refused (BUG 9)."""
import os
import sys

from geometry_msgs.msg import PoseStamped

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Frames(GuardedTest):
    def test_frames(self):
        self.uav.take_off()
        before = self.uav.state
        pose = PoseStamped()
        pose.header.frame_id = 'camera_link'
        pose.pose.position.x = 3.0
        pose.pose.orientation.w = 1.0
        self.uav.pose.publish(pose)
        self.uav.wait('the refusal', lambda: self.uav.state.dropped_set_points >
                      before.dropped_set_points)
        self.assertEqual(self.uav.state.mode, 'holding')

        def renamed(message):
            message.header.frame_id = 'ned'
            message.pose.pose.position.z *= -1.0
            return message
        self.uav.spoil = renamed
        self.uav.wait_mode('emergency descent')
        self.uav.wait_mode('disarmed')
        self.assertFalse(self.uav.status.crashed, self.uav.status.crash_reason)


if __name__ == '__main__':
    run(Frames)
