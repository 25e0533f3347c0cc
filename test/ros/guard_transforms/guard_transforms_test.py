#!/usr/bin/python3
"""What tf2 knows is flown as if it were told in the own frames."""
import math
import os
import sys

import rospy
from geometry_msgs.msg import Point, PoseStamped, Quaternion, TransformStamped
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402
from uav import yaw_quaternion  # noqa: E402


class Transforms(GuardedTest):
    def test_transforms(self):
        tf = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        # The map is turned by 90 deg to the left and lies 2 m ahead of the world's origin; the
        # camera sits 0.2 m in front of the vehicle's.
        tf.publish(TFMessage([self.transform('world', 'map', 2.0, math.pi / 2),
                              self.transform('base_link', 'camera', 0.2, 0.0)]))
        self.uav.take_off()
        self.uav.spoil = self.told_by_camera
        self.uav.sleep(3.0)
        self.assertEqual(self.uav.state.mode, 'holding')
        self.assertLess(self.uav.state.dropped_odometry, 25)  # a tenth of a second
        self.assertLess(abs(self.uav.truth.x), 0.1)
        pose = PoseStamped()
        pose.header.frame_id = 'map'
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = 1.0, 0.5, 1.2
        pose.pose.orientation.w = 1.0
        self.uav.pose.publish(pose)
        self.uav.sleep(8.0)
        self.assertAlmostEqual(self.uav.truth.x, 1.5, delta=0.1)
        self.assertAlmostEqual(self.uav.truth.y, 1.0, delta=0.1)
        self.assertAlmostEqual(self.uav.state.desired_yaw, math.pi / 2, delta=0.01)

    @staticmethod
    def transform(parent, child, x, yaw):
        message = TransformStamped()
        message.header.frame_id, message.child_frame_id = parent, child
        message.transform.translation.x = x
        yaw_quaternion(message.transform.rotation, yaw)
        return message

    @staticmethod
    def told_by_camera(message):
        """The same motion as that of the camera in the map."""
        message.header.frame_id, message.child_frame_id = 'map', 'camera'
        pose, twist = message.pose.pose, message.twist.twist
        q = pose.orientation
        ahead = (1 - 2 * (q.y ** 2 + q.z ** 2), 2 * (q.x * q.y + q.z * q.w),
                 2 * (q.x * q.z - q.y * q.w))
        x, y, z = (c + 0.2 * a for c, a in zip(
            (pose.position.x, pose.position.y, pose.position.z), ahead))
        pose.position = Point(y, -(x - 2.0), z)
        s = math.sqrt(0.5)  # q of a turn by -90 deg about z: (0, 0, -s, s)
        pose.orientation = Quaternion(s * (q.x + q.y), s * (q.y - q.x), s * (q.z - q.w),
                                      s * (q.w + q.z))
        twist.linear.y += 0.2 * twist.angular.z
        twist.linear.z -= 0.2 * twist.angular.y
        return message

if __name__ == '__main__':
    run(Transforms)
