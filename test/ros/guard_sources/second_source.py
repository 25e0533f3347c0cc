"""An estimator of its own that is 0.3 m off: run in a process of its own by the test."""
import rospy
from nav_msgs.msg import Odometry

rospy.init_node('second_source')
publisher = rospy.Publisher('/uav/heard', Odometry, queue_size=10, tcp_nodelay=True)


def tell(message):
    message.pose.pose.position.x -= 0.3
    publisher.publish(message)


rospy.Subscriber('/uav/odometry', Odometry, tell, tcp_nodelay=True)
rospy.spin()
