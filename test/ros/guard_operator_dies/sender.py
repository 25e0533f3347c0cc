"""Sends 3 m in 4 s: run in a process of its own by the test, which kills it on the way."""
import rospy
from geometry_msgs.msg import Transform, Twist
from trajectory_msgs.msg import MultiDOFJointTrajectory, MultiDOFJointTrajectoryPoint

rospy.init_node('operator')
publisher = rospy.Publisher('/uav/command/trajectory', MultiDOFJointTrajectory, queue_size=1)
while publisher.get_num_connections() == 0:
    rospy.sleep(0.05)
message = MultiDOFJointTrajectory()
message.header.stamp = rospy.Time.now()
for i in range(81):
    s = i / 80.0
    point = MultiDOFJointTrajectoryPoint()
    point.time_from_start = rospy.Duration(4.0 * s)
    transform = Transform()
    transform.translation.x, transform.translation.z = 3.0 * s * s * (3.0 - 2.0 * s), 1.2
    transform.rotation.w = 1.0
    point.transforms, point.velocities = [transform], [Twist()]
    message.points.append(point)
publisher.publish(message)
rospy.spin()
